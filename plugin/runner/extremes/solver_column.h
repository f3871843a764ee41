// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "nscdd/host/solver_registry.h"

namespace nscdd {

/// A solver as the map shows it: one column.
struct SolverColumn {
  std::string name;  ///< for instance nscdd/anderson
  std::string solver;
  std::vector<std::pair<std::string, std::string>> options;
};

/// A column per solver of the plugins, or one per acceleration where a solver has several. `wanted` (empty: all) keeps the
/// columns whose name or solver is in it; throws Error on a word that fits none.
std::vector<SolverColumn> MakeColumns(const SolverRegistry& registry, const std::vector<std::string>& wanted);

}  // namespace nscdd
