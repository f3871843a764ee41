// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "solver_settings.h"

namespace nscdd {

/// `nscdd check`: reads the scene, builds it, looks at its first contacts and says what it found, without solving. `adapter`
/// empty: as the scene says. Throws Error on bad input.
void Check(const std::filesystem::path& scene, const std::string& adapter, const SolverRequest& request);

}  // namespace nscdd
