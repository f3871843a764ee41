// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tradeoff/setting.h"

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

}  // namespace nscdd
