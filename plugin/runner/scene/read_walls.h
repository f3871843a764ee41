// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "scene/table_reader.h"

namespace nscdd {

/// Reads what [[walls]] say and appends it to scene->bodies; materials and periodicity are in `scene` already.
void ReadWalls(TableReader* root, Scene* scene);

}  // namespace nscdd
