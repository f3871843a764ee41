// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/host/plugin_library.h"

namespace nscdd {

/// One thing that a valid plugin does; `run` throws Error with a sentence if it does not. Runs in a child process.
struct Check {
  std::string name;
  std::function<void(const std::string& path)> run;
};

/// The library, its header, its lists.
std::vector<Check> EntryChecks();
/// Life of handles and steps over a host.
std::vector<Check> HandleChecks();
/// Single problems with closed forms.
std::vector<Check> ProblemChecks();
/// What must be refused with a sentence.
std::vector<Check> RefusalChecks();

/// All of them; the first loads the plugin, and without it the others make no sense.
std::vector<Check> AllChecks();

/// Throws Error(sentence) unless `holds`.
inline void Expect(bool holds, const std::string& sentence) {
  if (!holds) throw Error(sentence);
}

/// Calls f(name) for each solver; an Error gets the solver's name in front.
template <class Function>
void ForEachSolver(const PluginLibrary& library, Function&& f) {
  for (std::uint64_t i = 0; i < library.plugin().solver_count; ++i) {
    const std::string name = library.plugin().solvers[i].name;
    try {
      f(name);
    } catch (const Error& e) {
      throw Error(fmt::format("solver '{}': {}", name, e.what()));
    }
  }
}

}  // namespace nscdd
