// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mpi_session.h"
#include "solver_settings.h"

namespace nscdd {

/// `nscdd check`: reads the scene, builds it, looks at its first contacts and says what it found, without solving. `adapter`
/// empty: as the scene says. Throws Error on bad input.
void Check(const std::filesystem::path& scene, const std::string& adapter, const SolverRequest& request);

/// `nscdd export`; empty paths and strings: not asked for, or as the scene says.
struct ExportRequest {
  std::filesystem::path input;  ///< a scene, or a problem file (.json)
  SolverRequest solver;
  std::string adapter;
  std::int64_t step = 1;        ///< of the scene, from 1
  std::filesystem::path fclib;  ///< file to write in FCLib's HDF5 format
  std::filesystem::path json;   ///< file to write that `nscdd solve` reads
};

/// Solves the scene up to the step, or the problem, and writes that contact problem with the answer. Prints what it wrote and
/// how good the answer is. Throws Error on bad input.
void Export(const ExportRequest& request);

struct ExtremesRequest {
  std::string plugin;
  std::vector<std::string> solvers;  ///< names of columns or solvers; empty: all
  std::filesystem::path out = "results/extremes";
  bool quick = false;  ///< a short version: some cases of each family, fewer iterations
};

/// `nscdd extremes`: runs the cases at the edges with every solver, prints the map and leaves extremes.csv and extremes.png.
/// Returns 1 if a solver was wrong without saying so, else 0. Throws Error on bad input.
int Extremes(const ExtremesRequest& request);

/// `nscdd solve`: solves one problem file and prints the solution as JSON, with the share of the impulses that no velocity sees
/// if `self_stress`. Throws Error on bad input.
void Solve(const std::filesystem::path& problem, const SolverRequest& request, bool self_stress);

/// `nscdd solvers`: the solvers of a plugin with their options, units and defaults. Throws Error if it cannot be loaded.
void ListSolvers(const std::string& plugin);

/// `nscdd tradeoff`; empty strings and missing values: the defaults that the help states.
struct TradeoffRequest {
  std::filesystem::path scene;
  SolverRequest solver;  ///< plugin; options that all settings share
  std::string adapter;
  std::vector<std::string> solvers;  ///< only settings of these
  std::filesystem::path settings;    ///< file of settings instead of the built-in list
  std::string observable = "centre_of_mass_y";
  std::string accuracy = "nat";
  std::optional<double> budget;  ///< [s] a step
  std::optional<std::int64_t> steps;
  std::optional<std::int64_t> problems;
  std::optional<int> repetitions;
  std::optional<double> time_limit;  ///< [s] of the measurement
  std::string out;
  bool cold = false;  ///< the recorded problems are solved from zero impulses
  bool quick = false;
  bool store = false;  ///< also put the front beside the scene
  bool quiet = false;
};

/// Measures on the user's scene what each saved second costs in accuracy; see sample_scenes/tradeoff/README.md. One process.
/// Throws Error on bad input; settings that fail are rows that say so.
void Tradeoff(const TradeoffRequest& request);

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
