// SPDX-License-Identifier: Apache-2.0
#include "scene/platform.h"

#include <fmt/format.h>

#include <vector>

#include "nscdd/error.h"
#include "scene/hosts.h"
#include "scene/names.h"

namespace nscdd {

std::unique_ptr<Platform> MakePlatform(const std::string& name, const Scene& scene) {
  if (name == "reference") return MakeReferencePlatform(scene);
  if (name == "box2d") return MakeBox2dPlatform(scene);
  const std::vector<std::string> names = {"box2d", "reference"};
  throw Error(Sentence(fmt::format("Adapter '{}' is unknown; {}", name, Suggestion(name, names, "known adapters"))));
}

}  // namespace nscdd
