// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace nscdd {

/// Writes the free disks of a finished run as a packing: id,x,y,angle,radius that [[disks]] file = "..." reads back, at rest,
/// with the digits of `final_csv` untouched. Call it on one rank. Throws Error when a body of the scene is not in `final_csv`
/// or the file cannot be written.
void WritePacking(const Scene& scene, const std::filesystem::path& final_csv, const std::filesystem::path& packing);

}  // namespace nscdd
