// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "nscdd/conformance/hooks.h"
#include "nscdd/reference/reference_adapter.h"

namespace nscdd {

/// Hooks of the reference platform; the callback adapter's derive from them.
class ReferenceHost : public conformance::Host {
 public:
  explicit ReferenceHost(double period) {
    world_.period = period;
    adapter_.emplace(&world_);
  }

  PlatformAdapter* adapter() override { return &*adapter_; }
  double precision() const override { return 0.0; }
  std::int64_t AddDisk(const conformance::DiskSpec& spec) override;
  std::optional<std::int64_t> AddCluster(const conformance::ClusterSpec& spec) override;
  std::optional<std::int64_t> AddPolyline(const conformance::PolylineSpec& spec) override;
  std::optional<std::int64_t> AddHalfPlane(const conformance::HalfPlaneSpec& spec) override;
  bool NeverTouch(std::int64_t one, std::int64_t other) override;
  void SetGravity(Vec2 gravity) override { world_.gravity = gravity; }
  conformance::BodyState Read(std::int64_t id) override { return {world_.Find(id)->pose, world_.Find(id)->velocity}; }
  void Move(std::int64_t id, const Pose& pose) override { world_.Find(id)->pose = pose; }
  void Remove(std::int64_t id) override { world_.Remove(id); }

 private:
  reference::World world_;
  std::optional<reference::ReferenceAdapter> adapter_;
};

}  // namespace nscdd
