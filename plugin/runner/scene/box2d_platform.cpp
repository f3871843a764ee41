// SPDX-License-Identifier: Apache-2.0
#include <box2d/box2d.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/error.h"
#include "scene/body_stream.h"
#include "scene/platform.h"

namespace nscdd {
namespace {

/// Half the length of the edge that stands for a half-plane [Box2D units]; the exact geometry has no ends.
constexpr double kHalfEdge = 1e5;
constexpr double kLargest = 1e18;  // its square is a float, too

box2d::Box2dOptions Options(const Scene& scene) {
  box2d::Box2dOptions options;
  options.metres_per_unit = Box2dMetresPerUnit(scene);
  if (scene.periodic) {
    options.period = scene.periodic->length;
    options.period_origin = scene.periodic->origin;
  }
  return options;
}

class Box2dPlatform final : public Platform {
 public:
  explicit Box2dPlatform(const Scene& scene)
      : metres_per_unit_(Box2dMetresPerUnit(scene)), world_(b2Vec2(0.0f, 0.0f)), adapter_(&world_, Options(scene)) {
    world_.SetAllowSleeping(false);
  }

  PlatformAdapter& adapter() override { return adapter_; }

  void Add(const BodyDefinition& body) override {
    CheckRange(body);
    // Kinematic, not static: its velocity may be set during the run.
    b2BodyDef definition;
    definition.type = body.kind == BodyKind::kFree ? b2_dynamicBody : b2_kinematicBody;
    definition.position = Units(Centre(body.pose));
    definition.angle = static_cast<float>(body.pose.angle);
    definition.allowSleep = false;
    b2Body* host = world_.CreateBody(&definition);
    box2d::ExactBody exact{body.pose, body.velocity, {}, {}, {}};
    AddFixtures(body, host, &exact);
    if (body.kind == BodyKind::kFree) SetMass(body, host, &exact);
    adapter_.Assign(host, body.id, exact);
  }

  void SetGravity(Vec2 gravity) override { adapter_.SetGravity(gravity); }
  void SetVelocity(std::int64_t id, const Twist& velocity) override { adapter_.SetVelocity(id, velocity); }
  bool Restore(std::int64_t id, const Pose& pose, const Twist& velocity) override {
    if (adapter_.Find(id) == nullptr) return false;
    adapter_.SetPose(id, pose);
    adapter_.SetVelocity(id, velocity);
    return true;
  }

 private:
  /// Box2D squares its floats, and ends the program where one of them is not finite.
  void CheckRange(const BodyDefinition& body) const {
    const double unit = metres_per_unit_;
    double largest = std::max({std::abs(body.pose.x) / unit, std::abs(body.pose.y) / unit, std::abs(body.pose.angle), body.mass,
                               body.inertia / (unit * unit), body.friction});
    const auto add = [&](Vec2 point) { largest = std::max({largest, std::abs(point.x) / unit, std::abs(point.y) / unit}); };
    for (const reference::Disk& disk : body.disks) {
      add(disk.centre);
      add({disk.radius, 0.0});
    }
    for (const reference::Segment& segment : body.segments) {
      add(segment.a);
      add(segment.b);
    }
    for (const reference::HalfPlane& plane : body.half_planes) add({plane.offset, 0.0});
    if (largest <= kLargest) return;
    throw Error(fmt::format(
        "Body {} has the number {:.3g}, in Box2D's units, where its range ends at {:.0e}; use adapter = \"reference\".",
        body.id, largest, kLargest));
  }

  float Units(double metres) const { return static_cast<float>(metres / metres_per_unit_); }
  b2Vec2 Units(Vec2 metres) const { return {Units(metres.x), Units(metres.y)}; }

  /// In the order disks, segments, half-planes, as on the reference platform: contact keys are then the same on both.
  void AddFixtures(const BodyDefinition& body, b2Body* host, box2d::ExactBody* exact) const {
    for (const reference::Disk& disk : body.disks) {
      b2CircleShape circle;
      circle.m_p = Units(disk.centre);
      circle.m_radius = Units(disk.radius);
      AddFixture(body, circle, box2d::DiskGeometry{disk.centre, disk.radius}, host, exact);
    }
    for (const reference::Segment& segment : body.segments) {
      b2EdgeShape edge;
      edge.SetTwoSided(Units(segment.a), Units(segment.b));
      AddFixture(body, edge, box2d::SegmentGeometry{segment.a, segment.b}, host, exact);
    }
    for (const reference::HalfPlane& plane : body.half_planes) {
      const Vec2 along{plane.normal.y, -plane.normal.x}, foot = plane.offset * plane.normal;
      const double half = kHalfEdge * metres_per_unit_;
      b2EdgeShape edge;
      edge.SetTwoSided(Units(foot - half * along), Units(foot + half * along));
      AddFixture(body, edge, box2d::HalfPlaneGeometry{plane.normal, plane.offset}, host, exact);
    }
  }

  template <typename Geometry>
  void AddFixture(const BodyDefinition& body, const b2Shape& shape, const Geometry& geometry, b2Body* host,
                  box2d::ExactBody* exact) const {
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = static_cast<float>(body.friction);
    fixture.restitution = static_cast<float>(body.restitution);
    host->CreateFixture(&fixture);
    exact->shapes.push_back({geometry, body.friction, body.restitution});
  }

  void SetMass(const BodyDefinition& body, b2Body* host, box2d::ExactBody* exact) const {
    b2MassData mass;
    mass.mass = static_cast<float>(body.mass);
    mass.center.SetZero();
    mass.I = static_cast<float>(body.inertia / (metres_per_unit_ * metres_per_unit_));
    host->SetMassData(&mass);
    exact->mass = body.mass;
    exact->inertia = body.inertia;
  }

  double metres_per_unit_;
  b2World world_;
  box2d::Box2dAdapter adapter_;
};

}  // namespace

/// Box2D's lengths (slop, skin, margin) suit bodies of 0.1 to 10 units. Powers of two change no digit of a float.
double Box2dMetresPerUnit(const Scene& scene) {
  const double radius = MeanGrainRadius(scene);
  return radius >= 0.1 && radius <= 10.0 ? 1.0 : std::exp2(std::round(std::log2(radius)));
}

std::unique_ptr<Platform> MakeBox2dPlatform(const Scene& scene) { return std::make_unique<Box2dPlatform>(scene); }

}  // namespace nscdd
