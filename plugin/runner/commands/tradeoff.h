// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver_settings.h"

namespace nscdd {

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

}  // namespace nscdd
