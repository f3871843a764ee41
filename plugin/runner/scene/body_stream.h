// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "scene/body_definition.h"
#include "scene/scene.h"

namespace nscdd {

/// Bodies of the scene, walls included.
std::int64_t CountBodies(const Scene& scene);

/// Do its bodies have no id of their own? They take free ones, in the order of the scene.
bool TakesFreeIds(const BodySource& source);

/// Calls `visit` for the bodies of this rank in the order of the scene: number k of n goes to rank floor(k ranks / n). Holds
/// one body at a time (and the surface of a deposition). Throws Error when a file that it names has changed since the scene was
/// read.
void ForEachBody(const Scene& scene, int rank, int ranks, const std::function<void(const BodyDefinition&)>& visit);

/// The ids that are left for bodies without one. Reads the tables that have ids; needs 16 bytes per body with an id of its own,
/// for the duration of the call. Throws Error, naming both places, if two bodies have the same.
FreeIds FindFreeIds(const Scene& scene);

}  // namespace nscdd
