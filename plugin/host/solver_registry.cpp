// SPDX-License-Identifier: Apache-2.0
#include "nscdd/host/solver_registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "nscdd/error.h"

namespace nscdd {

void SolverRegistry::Add(const std::string& path) {
  const std::shared_ptr<const PluginLibrary> library = PluginLibrary::Load(path);
  std::vector<Entry> all = entries_;
  for (std::uint64_t i = 0; i < library->plugin().solver_count; ++i) {
    const nscdd_solver_info* info = &library->plugin().solvers[i];
    const std::string name = info->name;
    const auto same = std::find_if(all.begin(), all.end(), [&](const Entry& e) { return name == e.info->name; });
    if (same != all.end()) {
      throw Error(fmt::format("plugin '{}': its solver '{}' has the name of one of plugin '{}'; load only one of the two", path,
                              name, same->module->path()));
    }
    all.push_back({library, info});
  }
  entries_ = std::move(all);
}

const SolverRegistry::Entry& SolverRegistry::Find(const std::string& solver) const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_) {
    if (solver == entry.info->name) return entry;
    names.emplace_back(entry.info->name);
  }
  throw Error(fmt::format("there is no solver '{}'; the loaded plugins have {}", solver, fmt::join(names, ", ")));
}

Solver SolverRegistry::Create(const SolverArguments& arguments) const {
  return Solver(Find(arguments.solver).module, arguments);
}

void SolverRegistry::CheckOption(const std::string& solver, const std::string& option, const std::string& value) const {
  nscdd::CheckOption(Find(solver).module, solver, option, value);
}

}  // namespace nscdd
