// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "mpi_session.h"
#include "solver_settings.h"

namespace nscdd {

/// `nscdd run`; empty strings and missing values: as the scene says.
struct RunRequest {
  std::filesystem::path scene;
  std::filesystem::path resume;  ///< folder of a run to go on with, instead of a scene
  SolverRequest solver;
  std::string adapter;
  std::optional<std::int64_t> steps;
  std::optional<std::int64_t> save_every;
  std::optional<std::int64_t> checkpoint_every;
  std::string out;
  bool quiet = false;
};

/// Solves the scene step by step and writes its results, or goes on with an earlier run. Collective. Returns the exit code:
/// 0, 3 when the scene asks to stop at the first step that does not converge and one did not, or 4 when a signal ended the run
/// and it can be resumed. Throws Error, the same on all ranks, on bad input.
int Run(const RunRequest& request, const MpiSession& session);

}  // namespace nscdd
