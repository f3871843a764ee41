// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nscdd {

/// Writes the free disks of a finished run as a packing: id,x,y,angle,radius,vx,vy,spin, and material if the scene names
/// materials, that [[disks]] file = "..." reads back, with the digits of `final_csv` untouched. Call it on one rank. Returns a
/// sentence about what a table of disks cannot hold, "" if that is nothing. Throws Error when a body of the scene is not in
/// `final_csv` or the file cannot be written.
std::string WritePacking(const Scene& scene, const std::filesystem::path& final_csv, const std::filesystem::path& packing);

}  // namespace nscdd
