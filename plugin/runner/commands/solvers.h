// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace nscdd {

/// `nscdd solvers`: the solvers of a plugin with their options, units and defaults. Throws Error if it cannot be loaded.
void ListSolvers(const std::string& plugin);

}  // namespace nscdd
