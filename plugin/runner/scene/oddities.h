// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace nscdd {

/// Adds notes on what is legal in a scene and yet hardly meant: angles of gravity in degrees, gravity upwards, free bodies that
/// nothing will catch, lengths in mixed units. Walks through all bodies once; of scenes with more than ten million it judges
/// gravity alone. Throws Error when a CSV file has changed since the scene was read.
void NoteOddities(Scene* scene);

}  // namespace nscdd
