// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/host/plugin_library.h"

namespace nscdd {
namespace {

constexpr const char* kFile = "libnscdd_solver.so";

std::vector<std::filesystem::path> Places() {
  std::vector<std::filesystem::path> places;
  const std::filesystem::path install_folder = NSCDD_INSTALL_LIBDIR;
  std::error_code code;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
  if (!code) {
    const std::filesystem::path prefix = program.parent_path().parent_path();
    places.push_back(prefix / "lib" / kFile);
    // An installation that was moved: lib64, or Debian's lib/<architecture>.
    places.push_back(prefix / "lib" / install_folder.filename() / kFile);
    places.push_back(prefix / install_folder.filename() / kFile);
  }
  places.push_back(install_folder / kFile);
  return places;
}

}  // namespace

std::string FindPlugin(const std::string& option) {
  if (!option.empty()) return option;
  const char* environment = std::getenv("NSCDD_PLUGIN");
  if (environment != nullptr && *environment != '\0') return environment;
  std::vector<std::string> tried;
  for (const std::filesystem::path& place : Places()) {
    std::error_code code;
    if (std::filesystem::exists(place, code)) return place.string();
    tried.push_back(place.string());
  }
  throw Error(fmt::format("no solver plugin found: looked at {}; set the environment variable NSCDD_PLUGIN to the path of {}",
                          fmt::join(tried, ", "), kFile));
}

}  // namespace nscdd
