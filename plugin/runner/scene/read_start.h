// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "scene/table_reader.h"

namespace nscdd {

/// Reads [start]: the bodies of a state file, its materials, its period and its clock go into the scene. Before [periodic],
/// [[materials]] and the bodies are read, after [time].
void ReadStart(TableReader* root, Scene* scene);

}  // namespace nscdd
