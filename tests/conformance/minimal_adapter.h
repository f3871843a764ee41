// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>

#include "nscdd/platform_adapter.h"

namespace nscdd::minimal {

/// A body of the smallest possible platform: a disk, or a fixed half-plane through its position.
struct Body {
  bool is_fixed = false;
  bool is_plane = false;
  Pose pose;
  Twist velocity;
  double radius = 0.0;   // of a disk [m]
  double density = 1.0;  // of a disk [kg/m^2]
  Vec2 normal;           // of a half-plane: unit, to the free side
  double friction = 0.0;
  double restitution = 0.0;
};

struct World {
  Vec2 gravity;
  std::map<std::int64_t, Body> bodies;  // by id
};

/// The smallest adapter: all pairs, disks and half-planes, no clusters, no moving walls, no transport, no period.
class MinimalAdapter final : public PlatformAdapter {
 public:
  explicit MinimalAdapter(World* world) : world_(world) {}

  AdapterDescription Describe() const override { return {.name = "minimal", .version = "1"}; }
  void ReadBodies(BodyTable* bodies) override;
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  void Commit(const StepResult& result) override;
  BodyTransport* transport() override { return nullptr; }

 private:
  World* world_;
};

}  // namespace nscdd::minimal
