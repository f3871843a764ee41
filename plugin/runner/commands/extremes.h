// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nscdd {

struct ExtremesRequest {
  std::string plugin;
  std::vector<std::string> solvers;  ///< names of columns or solvers; empty: all
  std::filesystem::path out = "results/extremes";
  bool quick = false;  ///< a short version: some cases of each family, fewer iterations
};

/// `nscdd extremes`: runs the cases at the edges with every solver, prints the map and leaves extremes.csv and extremes.png.
/// Returns 1 if a solver was wrong without saying so, else 0. Throws Error on bad input.
int Extremes(const ExtremesRequest& request);

}  // namespace nscdd
