// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace nscdd {

/// Whole sentences about what is legal in a scene and yet hardly meant: angles of gravity in degrees, gravity upwards, free
/// bodies that nothing will catch, lengths in mixed units. Walks through all bodies once; of scenes with more than ten million
/// it judges gravity alone.
std::vector<std::string> OdditiesOf(const Scene& scene);

}  // namespace nscdd
