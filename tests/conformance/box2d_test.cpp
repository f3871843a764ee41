// SPDX-License-Identifier: Apache-2.0
// The Box2D adapter over a world that a Box2D user built: everything but the ids goes through Box2D's own interface.
#include <box2d/box2d.h>

#include <vector>

#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/conformance/hooks.h"

namespace nscdd {
namespace {

b2Vec2 ToFloat(Vec2 a) { return {static_cast<float>(a.x), static_cast<float>(a.y)}; }

class Box2dHost final : public conformance::Host {
 public:
  explicit Box2dHost(double period) : adapter_(&world_, Options(period)) {}

  PlatformAdapter* adapter() override { return &adapter_; }
  double precision() const override { return 1.2e-7; }

  std::int64_t AddDisk(const conformance::DiskSpec& spec) override {
    const bool moves = spec.velocity.vx != 0.0 || spec.velocity.vy != 0.0 || spec.velocity.spin != 0.0;
    b2BodyDef def;
    def.type = spec.kind == BodyKind::kFree ? b2_dynamicBody : moves ? b2_kinematicBody : b2_staticBody;
    def.position = ToFloat(spec.centre);
    def.linearVelocity = ToFloat(Linear(spec.velocity));
    def.angularVelocity = static_cast<float>(spec.velocity.spin);
    b2Body* body = world_.CreateBody(&def);
    AddCircle({}, spec.radius, spec, body);
    adapter_.Assign(body, spec.id);
    return spec.id;
  }

  std::optional<std::int64_t> AddCluster(const conformance::ClusterSpec& spec) override {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    b2Body* body = world_.CreateBody(&def);
    conformance::DiskSpec material;
    material.density = spec.density;
    for (const auto& member : spec.disks) AddCircle(member.centre, member.radius, material, body);
    adapter_.Assign(body, spec.id);
    return spec.id;
  }

  std::optional<std::int64_t> AddPolyline(const conformance::PolylineSpec& spec) override {
    b2BodyDef def;
    b2Body* body = world_.CreateBody(&def);
    std::vector<b2Vec2> points;  // a chain is solid to the left: reversed
    for (auto point = spec.points.rbegin(); point != spec.points.rend(); ++point) points.push_back(ToFloat(*point));
    b2ChainShape chain;
    chain.CreateChain(points.data(), static_cast<int>(points.size()), 2.0F * points[0] - points[1],
                      2.0F * points[points.size() - 1] - points[points.size() - 2]);
    b2FixtureDef fixture;
    fixture.shape = &chain;
    fixture.friction = static_cast<float>(spec.friction);
    fixture.restitution = static_cast<float>(spec.restitution);
    body->CreateFixture(&fixture);
    adapter_.Assign(body, spec.id);
    return spec.id;
  }

  /// Box2D has none.
  std::optional<std::int64_t> AddHalfPlane(const conformance::HalfPlaneSpec&) override { return std::nullopt; }

  bool NeverTouch(std::int64_t one, std::int64_t other) override {
    for (const std::int64_t id : {one, other}) {
      b2Fixture* fixture = adapter_.Find(id)->GetFixtureList();
      b2Filter filter = fixture->GetFilterData();
      filter.groupIndex = -1;
      fixture->SetFilterData(filter);
    }
    return true;
  }

  void SetGravity(Vec2 gravity) override { world_.SetGravity(ToFloat(gravity)); }

  conformance::BodyState Read(std::int64_t id) override {
    const b2Body* body = adapter_.Find(id);
    const b2Vec2 c = body->GetWorldCenter(), v = body->GetLinearVelocity();
    return {{c.x, c.y, body->GetAngle()}, {v.x, v.y, body->GetAngularVelocity()}};
  }

  /// Only disks are moved: their origin is their centre.
  void Move(std::int64_t id, const Pose& pose) override {
    adapter_.Find(id)->SetTransform(ToFloat(Centre(pose)), static_cast<float>(pose.angle));
  }

  void Remove(std::int64_t id) override { world_.DestroyBody(adapter_.Find(id)); }

 private:
  static box2d::Box2dOptions Options(double period) {
    box2d::Box2dOptions options;
    options.period = period;
    return options;
  }

  static void AddCircle(Vec2 centre, double radius, const conformance::DiskSpec& material, b2Body* body) {
    b2CircleShape circle;
    circle.m_p = ToFloat(centre);
    circle.m_radius = static_cast<float>(radius);
    b2FixtureDef fixture;
    fixture.shape = &circle;
    fixture.density = static_cast<float>(material.density);
    fixture.friction = static_cast<float>(material.friction);
    fixture.restitution = static_cast<float>(material.restitution);
    body->CreateFixture(&fixture);
  }

  b2World world_{{0.0F, 0.0F}};
  box2d::Box2dAdapter adapter_;
};

}  // namespace
}  // namespace nscdd

int main(int argc, char** argv) {
  return nscdd::conformance::Main(argc, argv, [](double period) { return std::make_unique<nscdd::Box2dHost>(period); });
}
