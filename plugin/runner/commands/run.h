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
  SolverRequest solver;
  std::string adapter;
  std::optional<std::int64_t> steps;
  std::optional<std::int64_t> save_every;
  std::string out;
  bool quiet = false;
};

/// Solves the scene step by step and writes its results. Collective. Returns the exit code: 0, or 3 when the scene asks to stop at
/// the first step that does not converge and one did not. Throws Error, the same on all ranks, on bad input.
int Run(const RunRequest& request, const MpiSession& session);

}  // namespace nscdd
