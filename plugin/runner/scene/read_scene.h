// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nscdd {

/// Reads and checks a scene file and, row by row, the tables that it names. The keys: sample_scenes/README.md.
/// Throws Error "FILE:LINE: key 'x.y' what is wrong; how to mend it." The option keys of [solver] are not checked here.
Scene ReadSceneFile(const std::filesystem::path& path);

/// The same of a text that stands, or once stood, at `path`.
Scene ParseScene(const std::string& text, const std::filesystem::path& path);

/// Adds notes on what is legal in a scene and yet hardly meant: angles of gravity in degrees, gravity upwards, free bodies that
/// nothing will catch, lengths in mixed units. Walks through all bodies once; of scenes with more than ten million it judges
/// gravity alone. Throws Error when a CSV file has changed since the scene was read.
void NoteOddities(Scene* scene);

}  // namespace nscdd
