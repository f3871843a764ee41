// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "scene/platform.h"

namespace nscdd {

std::unique_ptr<Platform> MakeReferencePlatform(const Scene& scene);
std::unique_ptr<Platform> MakeBox2dPlatform(const Scene& scene);

}  // namespace nscdd
