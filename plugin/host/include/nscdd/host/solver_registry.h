// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nscdd/host/plugin_library.h"
#include "nscdd/host/solver.h"

namespace nscdd {

/// The solvers of several plugins, by name.
class SolverRegistry {
 public:
  /// A solver and the plugin that it is in, which stays loaded as long as the entry lives.
  struct Entry {
    std::shared_ptr<const PluginLibrary> module;
    const nscdd_solver_info* info;
  };

  /// Loads `path` and adds its solvers. Throws Error as PluginLibrary::Load does, and when one of its solvers has the name of
  /// one that is there already; nothing is added then.
  void Add(const std::string& path);

  const std::vector<Entry>& entries() const { return entries_; }
  /// Throws Error with the names that exist.
  const Entry& Find(const std::string& solver) const;
  /// Makes a handle of arguments.solver.
  Solver Create(const SolverArguments& arguments) const;
  /// Throws Error with the solver's sentence when it does not take this value of this option.
  void CheckOption(const std::string& solver, const std::string& option, const std::string& value) const;

 private:
  std::vector<Entry> entries_;
};

}  // namespace nscdd
