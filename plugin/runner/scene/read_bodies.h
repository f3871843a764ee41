// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "scene/table_reader.h"

namespace nscdd {

/// Reads what [[disks]], [[lattices]], [[depositions]] and [[clusters]] say and appends it to scene->bodies. The materials and
/// the file's path are in `scene` already. Tables are read through once, to count and check their rows.
void ReadGrains(TableReader* root, Scene* scene);

/// The keys that every kind of body has: material, velocity, spin.
BodySource ReadSource(TableReader* entry, const Scene& scene);

/// Index of a material; throws Error "WHERE material ..." if the scene has none of this name.
int FindMaterial(const Scene& scene, const std::string& name, const std::string& where);

}  // namespace nscdd
