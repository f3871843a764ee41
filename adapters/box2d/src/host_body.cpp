// SPDX-License-Identifier: Apache-2.0
#include "host_body.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "nscdd/error.h"

namespace nscdd::box2d {
namespace {

/// Box2D keeps the accumulated load and the central inertia without accessors (GetInertia() is about the origin, and taking
/// m c^2 off it again costs digits). An explicit instantiation may name private members ([temp.spec.general]); this hands out
/// typed pointers to them, checked by the compiler, without any assumption on the layout.
template <typename Tag, auto kPointer>
struct Expose {
  friend constexpr auto Member(Tag) { return kPointer; }
};
struct Force {
  friend constexpr auto Member(Force);
};
struct Torque {
  friend constexpr auto Member(Torque);
};
struct Inertia {
  friend constexpr auto Member(Inertia);
};
template struct Expose<Force, &b2Body::m_force>;
template struct Expose<Torque, &b2Body::m_torque>;
template struct Expose<Inertia, &b2Body::m_I>;

class Hash {
 public:
  void Add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9E3779B97F4A7C15u;
    value_ ^= value_ >> 29;
  }
  void Add(float a, float b) { Add(std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b)); }
  void Add(b2Vec2 a) { Add(a.x, a.y); }
  void Add(const void* pointer) { Add(std::uint64_t{std::bit_cast<std::uintptr_t>(pointer)}); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x9E3779B97F4A7C15u;
};

void AddShape(const b2Shape& shape, Hash* hash) {
  switch (shape.GetType()) {
    case b2Shape::e_circle: {
      hash->Add(static_cast<const b2CircleShape&>(shape).m_p);
      hash->Add(shape.m_radius, 0.0f);
      break;
    }
    case b2Shape::e_edge: {
      const auto& edge = static_cast<const b2EdgeShape&>(shape);
      hash->Add(edge.m_vertex1);
      hash->Add(edge.m_vertex2);
      break;
    }
    case b2Shape::e_chain: {
      const auto& chain = static_cast<const b2ChainShape&>(shape);
      for (int i = 0; i < chain.m_count; ++i) hash->Add(chain.m_vertices[i]);
      break;
    }
    default: {
      const auto& polygon = static_cast<const b2PolygonShape&>(shape);
      for (int i = 0; i < polygon.m_count; ++i) hash->Add(polygon.m_vertices[i]);
    }
  }
}

const char* NameOf(b2Shape::Type type) {
  return type == b2Shape::e_edge ? "an edge" : type == b2Shape::e_chain ? "a chain" : "a polygon";
}

b2Vec2 Float(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

}  // namespace

HostMirror ReadMirror(const b2Body& body) {
  HostMirror mirror;
  mirror.position = body.GetPosition();
  mirror.local_centre = body.GetLocalCenter();
  mirror.angle = body.GetAngle();
  mirror.mass = body.GetMass();
  mirror.inertia = body.*Member(Inertia{});
  if (body.GetType() == b2_staticBody) {
    mirror.velocity.SetZero();
  } else {
    mirror.velocity = body.GetLinearVelocity();
    mirror.spin = body.GetAngularVelocity();
  }
  return mirror;
}

Pose PoseOf(const HostMirror& mirror, double scale) {
  const Vec2 arm = Rotate(mirror.angle, {mirror.local_centre.x, mirror.local_centre.y});
  return {scale * (mirror.position.x + arm.x), scale * (mirror.position.y + arm.y), mirror.angle};
}

Twist TwistOf(const HostMirror& mirror, double scale) {
  return {scale * mirror.velocity.x, scale * mirror.velocity.y, mirror.spin};
}

Wrench NativeLoad(const b2Body& body, double scale) {
  const b2Vec2 force = body.*Member(Force{});
  return {scale * force.x, scale * force.y, scale * scale * (body.*Member(Torque{}))};
}

std::uint64_t FingerprintOf(const b2Body& body) {
  Hash hash;
  hash.Add(body.GetLocalCenter());
  for (const b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
    const b2Filter& filter = fixture->GetFilterData();
    hash.Add(fixture);
    hash.Add(fixture->GetFriction(), fixture->GetRestitution());
    hash.Add(std::uint64_t{filter.categoryBits} << 48 | std::uint64_t{filter.maskBits} << 32 |
             std::uint64_t{static_cast<std::uint16_t>(filter.groupIndex)} << 16 | std::uint64_t{fixture->IsSensor()} << 8 |
             static_cast<std::uint64_t>(fixture->GetType()));
    AddShape(*fixture->GetShape(), &hash);
  }
  return hash.value();
}

void CheckFixtures(const b2Body& body, std::int64_t id) {
  if (body.GetType() != b2_dynamicBody || !body.IsEnabled()) return;
  for (const b2Fixture* fixture = body.GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) {
    if (fixture->IsSensor() || fixture->GetType() == b2Shape::e_circle) continue;
    throw Error(
        fmt::format("Box2D body {} is dynamic and has {} fixture; free bodies are made of circles only: give it circle "
                    "fixtures, or make it static or kinematic.",
                    id, NameOf(fixture->GetType())));
  }
}

void CheckMotion(const b2Body& body, std::int64_t id) {
  if (body.GetType() != b2_dynamicBody || !body.IsEnabled()) return;
  if (body.IsFixedRotation()) {
    throw Error(
        fmt::format("Box2D body {} has fixed rotation, which the solver does not model: call SetFixedRotation(false).", id));
  }
  if (!(body.GetMass() > 0.0f && body.*Member(Inertia{}) > 0.0f)) {
    throw Error(
        fmt::format("Box2D body {} is dynamic with mass {} and inertia {}: give its fixtures a density, or call SetMassData.",
                    id, body.GetMass(), body.*Member(Inertia{})));
  }
  if (body.GetLinearDamping() != 0.0f || body.GetAngularDamping() != 0.0f) {
    throw Error(
        fmt::format("Box2D body {} has linear damping {} and angular damping {}, which the solver does not model: set them "
                    "to zero, or apply a force.",
                    id, body.GetLinearDamping(), body.GetAngularDamping()));
  }
}

void WritePose(const Pose& pose, double scale, b2Body* body) {
  const b2Vec2 local = body->GetLocalCenter();
  const bool centred = local.x == 0.0f && local.y == 0.0f;
  const Vec2 arm = centred ? Vec2{} : Rotate(pose.angle, {local.x, local.y});
  const b2Vec2 position = Float(pose.x / scale - arm.x, pose.y / scale - arm.y);
  const auto angle = static_cast<float>(pose.angle);
  if (position == body->GetPosition() && angle == body->GetAngle()) return;
  body->SetTransform(position, angle);
}

void WriteVelocity(const Twist& velocity, double scale, b2Body* body) {
  if (body->GetType() == b2_staticBody) return;
  body->SetAwake(true);
  body->SetLinearVelocity(Float(velocity.vx / scale, velocity.vy / scale));
  body->SetAngularVelocity(static_cast<float>(velocity.spin));
}

void WriteMass(double mass, double inertia, double scale, b2Body* body) {
  const auto agrees = [](double exact, double host) { return std::abs(exact - host) <= 1e-6 * exact; };
  const double inertia_in_units = inertia / (scale * scale);
  if (body->GetType() != b2_dynamicBody) return;
  if (agrees(mass, body->GetMass()) && agrees(inertia_in_units, body->*Member(Inertia{}))) return;
  const b2Vec2 local = body->GetLocalCenter();
  b2MassData data;
  data.mass = static_cast<float>(mass);
  data.center = local;
  data.I = static_cast<float>(inertia_in_units) + data.mass * b2Dot(local, local);
  body->SetMassData(&data);
}

}  // namespace nscdd::box2d
