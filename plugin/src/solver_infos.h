// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nscdd/option_table.h"
#include "nscdd_plugin.h"

namespace nscdd {

using OptionTexts = std::vector<std::pair<std::string, std::string>>;  ///< name and value

/// Throws Error, with the nearest name, if there is no such solver.
const SolverEntry& FindSolver(std::string_view name);

/// The solver's defaults changed by `texts`. Throws Error on unknown or repeated names and on values that cannot be used.
SolverSettings MakeSettings(const SolverEntry& solver, const OptionTexts& texts);

/// SolverTable() as the C interface shows it; lives as long as the library.
std::span<const nscdd_solver_info> SolverInfos();

}  // namespace nscdd
