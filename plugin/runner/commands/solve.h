// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "solver_settings.h"

namespace nscdd {

/// `nscdd solve`: solves one problem file and prints the solution as JSON, with the share of the impulses that no velocity sees
/// if `self_stress`. Throws Error on bad input.
void Solve(const std::filesystem::path& problem, const SolverRequest& request, bool self_stress);

}  // namespace nscdd
