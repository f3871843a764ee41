// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "nscdd/host/solver_registry.h"
#include "scene/scene.h"
#include "tradeoff/plan.h"

namespace nscdd {

/// A setting of a measured front, as `nscdd tradeoff` stores it beside a scene.
struct FrontEntry {
  Setting setting;
  double seconds = 0.0;           ///< a step
  double nat = 0.0;               ///< [-] median
  double interpenetration = 0.0;  ///< largest of the run [mean radii]
};

/// SCENE.front.csv for SCENE.toml.
std::filesystem::path FrontFileOf(const std::filesystem::path& scene);

/// In the order of the file: ascending in seconds. Columns solver, options, seconds, nat and interpenetration_max of
/// tradeoff.csv; others are not read. Throws Error, naming file and line, when one is missing or no number.
std::vector<FrontEntry> ReadFront(const std::filesystem::path& file);

/// Settings that `solver = "auto"` may use, each more accurate (and dearer) than the one before, all on one grid of subdomains.
/// The run begins with the first.
struct Ladder {
  std::vector<Setting> rungs;
  std::string origin;  ///< "safe defaults", or the front's file
};

/// What the plugin has of the built-in ladder for a grid such as "1x1" or "4x4":
/// one subdomain: nscd, accelerated: 20 iterations, nat 1e-3, 1e-4, 1e-5, then newton;
/// several: iea, iea with closing iterations of nscdd, then nscdd, accelerated: nat 1e-3, 1e-4, 1e-5.
std::vector<Setting> SafeLadder(const std::string& grid, const SolverRegistry& registry);

/// The measured front from its first entry that serves the wish: the cheapest within the wanted interpenetration (with nothing
/// so good, the most accurate one), without that wish the most accurate within the budget; then the more accurate ones on the
/// same grid, then the built-in rungs that do not iterate a fixed number of times. `grid`: what the scene asks for, "" if
/// nothing; `ranks` at most as many as subdomains. Without a usable entry the built-in ladder.
Ladder MakeLadder(const AutoSettings& wish, const std::string& grid, int ranks, const std::vector<FrontEntry>& front,
                  const std::string& front_file, const SolverRegistry& registry);

}  // namespace nscdd
