// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "scene/platform.h"

namespace nscdd {

std::unique_ptr<Platform> MakeReferencePlatform(const Scene& scene);
std::unique_ptr<Platform> MakeBox2dPlatform(const Scene& scene);
/// Length of a Box2D unit on that platform [m].
double Box2dMetresPerUnit(const Scene& scene);

}  // namespace nscdd
