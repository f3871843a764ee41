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
  throw Error(fmt::format("Adapter '{}' is unknown; {}.", name, Suggestion(name, std::vector<std::string>{"box2d", "reference"}, "known adapters")));
}

}  // namespace nscdd
