// SPDX-License-Identifier: Apache-2.0
#include "nscdd/host/plugin_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "nscdd/error.h"

namespace nscdd {
namespace {

constexpr std::size_t kLongestString = 4096;
constexpr std::uint64_t kMostEntries = 10000;  // solvers, options: more is garbage

[[noreturn]] void Refuse(const std::string& path, const std::string& what) {
  throw Error(fmt::format("plugin '{}': {}", path, what));
}

// dlopen would search other folders for a bare name, and its message for a file that is no library helps nobody.
std::string CheckFile(const std::string& path) {
  std::error_code code;
  if (path.empty())
    throw Error("the path of the plugin is empty; give the path of a shared library such as libnscdd_solver.so");
  if (!std::filesystem::exists(path, code)) Refuse(path, "there is no such file; check the path");
  if (!std::filesystem::is_regular_file(path, code))
    Refuse(path, "it is not a regular file; give the path of a shared library");
  std::ifstream file(path, std::ios::binary);
  char magic[4] = {};
  if (!file) Refuse(path, "it cannot be read; check its permissions");
  file.read(magic, sizeof(magic));
  if (file.gcount() != 4 || std::memcmp(magic, "\177ELF", 4) != 0) {
    Refuse(path, "it is not a shared library (it does not begin with the ELF magic); give the path of a plugin's .so file");
  }
  return std::filesystem::absolute(path, code).string();
}

/// Bytes of nscdd_plugin that an ABI minor prescribes.
std::uint64_t SizeOfMinor(std::uint32_t minor) {
  if (minor < 1) return offsetof(nscdd_plugin, load_states);
  if (minor < 3) return offsetof(nscdd_plugin, check_option);
  return sizeof(nscdd_plugin);
}

void CheckHeader(const std::string& path, const nscdd_header& header, const HostAbi& abi) {
  if (header.abi_major != abi.major) {
    Refuse(path,
           fmt::format("it speaks ABI major {}, this program needs {}; rebuild the plugin with this program's nscdd_plugin.h",
                       header.abi_major, abi.major));
  }
  if (header.abi_minor < abi.minor) {
    Refuse(path, fmt::format("it speaks ABI {}.{}, this program needs at least {}.{}; update the plugin", header.abi_major,
                             header.abi_minor, abi.major, abi.minor));
  }
  if (header.struct_size < abi.struct_size) {
    Refuse(path, fmt::format("its nscdd_plugin has {} bytes, ABI {}.{} prescribes at least {}; set header.struct_size = "
                             "sizeof(nscdd_plugin) and rebuild it",
                             header.struct_size, abi.major, abi.minor, abi.struct_size));
  }
  const std::uint64_t own = SizeOfMinor(header.abi_minor);
  if (header.struct_size < own) {
    Refuse(path, fmt::format("its nscdd_plugin has {} bytes, its ABI {}.{} prescribes at least {}; set header.struct_size = "
                             "sizeof(nscdd_plugin) and rebuild it",
                             header.struct_size, header.abi_major, header.abi_minor, own));
  }
}

void CheckString(const std::string& path, const char* text, const std::string& what, bool may_be_empty) {
  if (text == nullptr) Refuse(path, fmt::format("{} is null; rebuild the plugin with a string there", what));
  if (strnlen(text, kLongestString) == kLongestString) {
    Refuse(path, fmt::format("{} does not end within {} bytes; terminate it", what, kLongestString));
  }
  if (!may_be_empty && *text == '\0') Refuse(path, fmt::format("{} is empty; give it a text", what));
}

void CheckMpi(const std::string& path, const nscdd_plugin& plugin, const HostAbi& abi) {
  CheckString(path, plugin.mpi_library, "mpi_library", true);
  if (*plugin.mpi_library == '\0' || abi.mpi_library == plugin.mpi_library) return;
  Refuse(path,
         fmt::format("it was built with the MPI '{}', this program with '{}'; communicators cannot cross: rebuild the plugin "
                     "with this program's MPI",
                     plugin.mpi_library, abi.mpi_library));
}

void CheckFunctions(const std::string& path, const nscdd_plugin& p) {
  const auto need = [&](bool present, const char* name) {
    if (!present) Refuse(path, fmt::format("the function {} is null; a plugin must provide it", name));
  };
  need(p.create != nullptr, "create");
  need(p.destroy != nullptr, "destroy");
  need(p.step != nullptr, "step");
  need(p.solve != nullptr, "solve");
  need(p.report != nullptr, "report");
  need(p.table != nullptr, "table");
  need(p.state_size != nullptr, "state_size");
  need(p.save_state != nullptr, "save_state");
  need(p.load_state != nullptr, "load_state");
  need(p.last_error != nullptr, "last_error");
  if (p.header.abi_minor >= 1) need(p.load_states != nullptr, "load_states");
  if (p.header.abi_minor >= 3) need(p.check_option != nullptr, "check_option");
}

void CheckOptions(const std::string& path, const nscdd_solver_info& solver) {
  if (solver.option_count > kMostEntries || (solver.options == nullptr && solver.option_count > 0)) {
    Refuse(path, fmt::format("solver '{}': {} options at {}; correct option_count and options", solver.name,
                             solver.option_count, solver.options == nullptr ? "null" : "a pointer"));
  }
  for (std::uint64_t i = 0; i < solver.option_count; ++i) {
    const nscdd_option& option = solver.options[i];
    const std::string where = fmt::format("solver '{}', option {}: ", solver.name, i);
    CheckString(path, option.name, where + "name", false);
    CheckString(path, option.default_value, where + "default_value", false);
    CheckString(path, option.unit, where + "unit", false);
    CheckString(path, option.choices, where + "choices", option.type != NSCDD_CHOICE);
    CheckString(path, option.help, where + "help", false);
    if (option.type < NSCDD_BOOL || option.type > NSCDD_GRID)
      Refuse(path, fmt::format("{}type {} is unknown", where, option.type));
  }
}

void CheckSolvers(const std::string& path, const nscdd_plugin& plugin) {
  if (plugin.solver_count == 0 || plugin.solver_count > kMostEntries || plugin.solvers == nullptr) {
    Refuse(path, fmt::format("it lists {} solvers at {}; a plugin has at least one", plugin.solver_count,
                             plugin.solvers == nullptr ? "null" : "a pointer"));
  }
  for (std::uint64_t i = 0; i < plugin.solver_count; ++i) {
    CheckString(path, plugin.solvers[i].name, fmt::format("the name of solver {}", i), false);
    CheckString(path, plugin.solvers[i].summary, fmt::format("the summary of solver '{}'", plugin.solvers[i].name), false);
    CheckOptions(path, plugin.solvers[i]);
  }
}

}  // namespace

HostAbi::HostAbi() : mpi_library(NSCDD_MPI_LIBRARY) {}

PluginLibrary::PluginLibrary(std::string path, void* library) : path_(std::move(path)), library_(library) {}

PluginLibrary::~PluginLibrary() { dlclose(library_); }

std::shared_ptr<const PluginLibrary> PluginLibrary::Load(const std::string& path, const HostAbi& abi) {
  const std::string file = CheckFile(path);
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) Refuse(path, fmt::format("it cannot be loaded: {}; install or rebuild what it needs", dlerror()));
  const std::shared_ptr<PluginLibrary> loaded(new PluginLibrary(path, library));
  void* symbol = dlsym(library, NSCDD_ENTRY_SYMBOL);
  if (symbol == nullptr) {
    Refuse(path, fmt::format("it has no symbol {}; it is not a solver plugin, or its symbol is hidden", NSCDD_ENTRY_SYMBOL));
  }
  const auto entry = reinterpret_cast<nscdd_plugin_entry_function>(symbol);
  loaded->plugin_ = entry();
  if (loaded->plugin_ == nullptr)
    Refuse(path, fmt::format("{} returned null; the plugin could not set itself up", NSCDD_ENTRY_SYMBOL));
  const nscdd_plugin& plugin = *loaded->plugin_;
  CheckHeader(path, plugin.header, abi);
  CheckMpi(path, plugin, abi);
  CheckString(path, plugin.name, "its name", false);
  CheckString(path, plugin.version, "its version", false);
  CheckFunctions(path, plugin);
  CheckSolvers(path, plugin);
  return loaded;
}

const nscdd_solver_info* PluginLibrary::FindSolver(const std::string& name) const {
  for (std::uint64_t i = 0; i < plugin_->solver_count; ++i) {
    if (name == plugin_->solvers[i].name) return &plugin_->solvers[i];
  }
  return nullptr;
}

const nscdd_option* FindOption(const nscdd_solver_info& solver, std::string_view name) {
  const nscdd_option* end = solver.options + solver.option_count;
  const nscdd_option* at = std::find_if(solver.options, end, [&](const nscdd_option& o) { return name == o.name; });
  return at == end ? nullptr : at;
}

void PluginLibrary::RequireLoadStates() const {
  if (plugin_->header.abi_minor >= 1) return;
  Refuse(path_, fmt::format("it speaks ABI {}.{}, checkpoints need 1.1 (load_states); update the plugin, or run without "
                            "checkpoints",
                            plugin_->header.abi_major, plugin_->header.abi_minor));
}

void* PluginLibrary::FindSymbol(const char* name) const { return dlsym(library_, name); }

}  // namespace nscdd
