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

/// Reads what [[walls]] say and appends it to scene->bodies; materials and periodicity are in `scene` already.
void ReadWalls(TableReader* root, Scene* scene);

/// Reads [start]: the bodies of a state file, its materials, its period and its clock go into the scene. Before [periodic],
/// [[materials]] and the bodies are read, after [time].
void ReadStart(TableReader* root, Scene* scene);

}  // namespace nscdd
