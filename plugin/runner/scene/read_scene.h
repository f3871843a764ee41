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

}  // namespace nscdd
