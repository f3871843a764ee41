// SPDX-License-Identifier: Apache-2.0
// The hooks of the smallest platform, and the program of its conformance tests.
#include "minimal_adapter.h"
#include "nscdd/conformance/hooks.h"

namespace nscdd::minimal {
namespace {

class MinimalHost final : public conformance::Host {
 public:
  PlatformAdapter* adapter() override { return &adapter_; }
  double precision() const override { return 0.0; }

  std::int64_t AddDisk(const conformance::DiskSpec& spec) override {
    Body body;
    body.is_fixed = spec.kind == BodyKind::kPrescribed;
    body.pose = {spec.centre.x, spec.centre.y, 0.0};
    body.velocity = spec.velocity;
    body.radius = spec.radius;
    body.density = spec.density;
    body.friction = spec.friction;
    body.restitution = spec.restitution;
    world_.bodies[spec.id] = body;
    return spec.id;
  }
  std::optional<std::int64_t> AddHalfPlane(const conformance::HalfPlaneSpec& spec) override {
    Body body;
    body.is_fixed = true;
    body.is_plane = true;
    body.pose = {spec.point.x, spec.point.y, 0.0};
    body.normal = spec.normal;
    body.friction = spec.friction;
    body.restitution = spec.restitution;
    world_.bodies[spec.id] = body;
    return spec.id;
  }
  std::optional<std::int64_t> AddCluster(const conformance::ClusterSpec&) override { return std::nullopt; }
  std::optional<std::int64_t> AddPolyline(const conformance::PolylineSpec&) override { return std::nullopt; }
  bool NeverTouch(std::int64_t, std::int64_t) override { return false; }

  void SetGravity(Vec2 gravity) override { world_.gravity = gravity; }
  conformance::BodyState Read(std::int64_t id) override { return {world_.bodies.at(id).pose, world_.bodies.at(id).velocity}; }
  void Move(std::int64_t id, const Pose& pose) override { world_.bodies.at(id).pose = pose; }
  void Remove(std::int64_t id) override { world_.bodies.erase(id); }

 private:
  World world_;
  MinimalAdapter adapter_{&world_};
};

}  // namespace
}  // namespace nscdd::minimal

int main(int argc, char** argv) {
  return nscdd::conformance::Main(
      argc, argv, [](double period) { return period == 0.0 ? std::make_unique<nscdd::minimal::MinimalHost>() : nullptr; });
}
