// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nscdd/reference/world.h"

namespace nscdd {

/// What a scene calls it.
enum class BodyRole : std::uint8_t { kDisk = 0, kCluster = 1, kWall = 2 };

/// A body, complete, as platforms take it; the reference platform's description serves all of them.
struct BodyDefinition : reference::Body {
  BodyRole role = BodyRole::kDisk;
  int material = 0;  ///< index in Scene::materials, where friction and restitution are from
};

}  // namespace nscdd
