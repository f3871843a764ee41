// SPDX-License-Identifier: Apache-2.0
#include "scene/platform.h"

#include <fmt/format.h>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/reference/reference_adapter.h"
#include "nscdd/reference/world.h"
#include "scene/text.h"

namespace nscdd {

std::unique_ptr<Platform> MakePlatform(const std::string& name, const Scene& scene) {
  if (name == "reference") return MakeReferencePlatform(scene);
  if (name == "box2d") return MakeBox2dPlatform(scene);
  const std::vector<std::string> names = {"box2d", "reference"};
  throw Error(Sentence(fmt::format("Adapter '{}' is unknown; {}", name, Suggestion(name, names, "known adapters"))));
}

namespace {

class ReferencePlatform final : public Platform {
 public:
  explicit ReferencePlatform(const Scene& scene) : adapter_(Prepare(scene, &world_)) {}

  PlatformAdapter& adapter() override { return adapter_; }
  void Add(const BodyDefinition& body) override { world_.Add(body); }
  void SetGravity(Vec2 gravity) override { world_.gravity = gravity; }

  void SetVelocity(std::int64_t id, const Twist& velocity) override {
    reference::Body* body = world_.Find(id);
    if (body == nullptr)
      throw Error(fmt::format("Body {} cannot get a velocity: the reference platform does not hold it.", id));
    body->velocity = velocity;
  }

  bool Restore(std::int64_t id, const Pose& pose, const Twist& velocity) override {
    reference::Body* body = world_.Find(id);
    if (body == nullptr) return false;
    body->pose = pose;
    body->velocity = velocity;
    return true;
  }

 private:
  static reference::World* Prepare(const Scene& scene, reference::World* world) {
    if (scene.periodic) {
      world->period = scene.periodic->length;
      world->period_origin = scene.periodic->origin;
    }
    return world;
  }

  reference::World world_;
  reference::ReferenceAdapter adapter_;
};

}  // namespace

std::unique_ptr<Platform> MakeReferencePlatform(const Scene& scene) { return std::make_unique<ReferencePlatform>(scene); }

}  // namespace nscdd
