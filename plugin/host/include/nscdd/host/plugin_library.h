// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nscdd_plugin.h"

namespace nscdd {

/// What this host needs from a plugin.
struct HostAbi {
  std::uint32_t major = NSCDD_ABI_MAJOR;
  std::uint32_t minor = 0;                                          ///< the least
  std::uint64_t struct_size = offsetof(nscdd_plugin, load_states);  ///< of this minor
  std::string mpi_library;                                          ///< first line of MPI_Get_library_version
  HostAbi();                                                        ///< of this build
};

/// A loaded and checked plugin; unloaded with the last owner. Solver handles own it.
class PluginLibrary {
 public:
  /// Loads the shared library `path` (RTLD_NOW | RTLD_LOCAL) and calls its entry symbol. Throws Error, naming the file, what
  /// was found, what is needed and the mend, when there is no such file, it is no shared library, the symbol is missing, the
  /// description is null, of another major, of a minor below `abi.minor`, truncated or for another MPI, or when a function or a
  /// string in it is missing. Until all of that is checked nothing but the entry symbol is called.
  static std::shared_ptr<const PluginLibrary> Load(const std::string& path, const HostAbi& abi = {});
  ~PluginLibrary();
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;

  const std::string& path() const { return path_; }
  const nscdd_plugin& plugin() const { return *plugin_; }
  /// Throws Error if the plugin is older than load_states (ABI minor 1): its runs cannot be resumed.
  void RequireLoadStates() const;
  /// Null if there is no such solver.
  const nscdd_solver_info* FindSolver(const std::string& name) const;
  /// Address of a symbol of the library or of what it depends on; null if there is none.
  void* FindSymbol(const char* name) const;

 private:
  PluginLibrary(std::string path, void* library);

  std::string path_;
  void* library_ = nullptr;
  const nscdd_plugin* plugin_ = nullptr;
};

/// Null if the solver has no such option.
const nscdd_option* FindOption(const nscdd_solver_info& solver, std::string_view name);

/// Path of the plugin to load: `option` if not empty, else the environment variable NSCDD_PLUGIN, else the first that exists of
/// libnscdd_solver.so in ../lib and in the library folder beside the program's own, and where this build was to be installed.
/// Throws Error with the places that were tried.
std::string FindPlugin(const std::string& option);

}  // namespace nscdd
