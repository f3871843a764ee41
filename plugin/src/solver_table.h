// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "option_table.h"

namespace nscdd {

/// A solver that the plugin offers: a name, the alternative of AlgorithmOptions that it stands for, and its options.
struct SolverEntry {
  std::string name;
  std::string summary;  ///< one line
  SolverSettings defaults;
  std::vector<Option> options;
};

using OptionTexts = std::vector<std::pair<std::string, std::string>>;  ///< name and value

/// Constant; made at the first call.
const std::vector<SolverEntry>& SolverTable();

/// Throws Error, with the nearest name, if there is no such solver.
const SolverEntry& FindSolver(std::string_view name);

/// The solver's defaults changed by `texts`. Throws Error on unknown or repeated names and on values that cannot be used.
SolverSettings MakeSettings(const SolverEntry& solver, const OptionTexts& texts);

/// SolverTable() as the C interface shows it; lives as long as the library.
std::span<const nscdd_solver_info> SolverInfos();

}  // namespace nscdd
