// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "nscdd/host/solver_registry.h"

namespace nscdd {
namespace {

std::string TypeOf(const nscdd_option& option) {
  switch (option.type) {
    case NSCDD_BOOL:
      return "true|false";
    case NSCDD_INTEGER:
      return "integer";
    case NSCDD_REAL:
      return "number";
    case NSCDD_GRID:
      return "NXxNY";
    default:
      return option.choices;
  }
}

}  // namespace

void ListSolvers(const std::string& plugin) {
  SolverRegistry registry;
  const std::string path = FindPlugin(plugin);
  registry.Add(path);
  const nscdd_plugin& description = registry.entries().front().module->plugin();
  fmt::print("{} {} ({})\n", description.name, description.version, path);
  for (const auto& entry : registry.entries()) {
    fmt::print("\n{}: {}\n", entry.info->name, entry.info->summary);
    for (std::uint64_t i = 0; i < entry.info->option_count; ++i) {
      const nscdd_option& o = entry.info->options[i];
      const std::string unit = std::string(o.unit) == "-" ? "" : fmt::format(" [{}]", o.unit);
      fmt::print("  {:<20} {:<10} {}{} ({})\n", o.name, o.default_value, o.help, unit, TypeOf(o));
    }
  }
}

}  // namespace nscdd
