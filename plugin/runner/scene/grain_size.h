// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace nscdd {

/// Mean radius of the scene's free disks [m], members of clusters counted each; generated ones count with the middle of their
/// range. Every rank gets the same number.
double MeanGrainRadius(const Scene& scene);

}  // namespace nscdd
