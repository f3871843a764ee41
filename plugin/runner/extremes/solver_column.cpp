// SPDX-License-Identifier: Apache-2.0
#include "extremes/extreme_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "nscdd/error.h"
#include "scene/text.h"

namespace nscdd {
namespace {

std::vector<SolverColumn> AllColumns(const SolverRegistry& registry) {
  std::vector<SolverColumn> columns;
  for (const auto& entry : registry.entries()) {
    const std::string solver = entry.info->name;
    const nscdd_option* acceleration = FindOption(*entry.info, "acceleration");
    if (acceleration == nullptr) {
      columns.push_back({solver, solver, {}});
      continue;
    }
    std::istringstream choices(acceleration->choices);
    for (std::string choice; std::getline(choices, choice, '|');) {
      columns.push_back({solver + "/" + choice, solver, {{"acceleration", choice}}});
    }
  }
  return columns;
}

}  // namespace

std::vector<SolverColumn> MakeColumns(const SolverRegistry& registry, const std::vector<std::string>& wanted) {
  std::vector<SolverColumn> columns = AllColumns(registry);
  if (wanted.empty()) return columns;
  const auto fits = [](const SolverColumn& column, const std::string& word) {
    return word == column.name || word == column.solver;
  };
  for (const std::string& word : wanted) {
    if (std::any_of(columns.begin(), columns.end(), [&](const auto& column) { return fits(column, word); })) continue;
    std::vector<std::string> names;
    for (const SolverColumn& column : columns) names.push_back(column.name);
    throw Error(fmt::format("--solvers: there is no '{}'; {}", word, Suggestion(word, names, "solvers")));
  }
  std::erase_if(columns, [&](const SolverColumn& column) {
    return std::none_of(wanted.begin(), wanted.end(), [&](const std::string& word) { return fits(column, word); });
  });
  return columns;
}

}  // namespace nscdd
