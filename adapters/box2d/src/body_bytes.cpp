// SPDX-License-Identifier: Apache-2.0
#include "body_bytes.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "fixture_bytes.h"
#include "host_body.h"

namespace nscdd::box2d {
namespace {

constexpr std::uint32_t kMagic = 0x4232444E;  // "ND2B"
constexpr std::uint32_t kVersion = 1;

void PutDefinition(const b2Body& body, Writer* out) {
  out->Put(static_cast<std::int32_t>(body.GetType()));
  out->Put(body.GetPosition());
  out->Put(body.GetAngle());
  out->Put(body.GetLinearVelocity());
  out->Put(body.GetAngularVelocity());
  out->Put(body.GetLinearDamping());
  out->Put(body.GetAngularDamping());
  out->Put(body.GetGravityScale());
  for (const bool flag :
       {body.IsSleepingAllowed(), body.IsAwake(), body.IsFixedRotation(), body.IsBullet(), body.IsEnabled()}) {
    out->Put(flag);
  }
}

b2BodyDef GetDefinition(Reader* in) {
  b2BodyDef def;
  const auto type = in->Get<std::int32_t>();
  if (type < b2_staticBody || type > b2_dynamicBody) in->Fail("hold a body of unknown type");
  def.type = static_cast<b2BodyType>(type);
  def.position = in->Get<b2Vec2>();
  def.angle = in->Get<float>();
  def.linearVelocity = in->Get<b2Vec2>();
  def.angularVelocity = in->Get<float>();
  def.linearDamping = in->Get<float>();
  def.angularDamping = in->Get<float>();
  def.gravityScale = in->Get<float>();
  for (bool* flag : {&def.allowSleep, &def.awake, &def.fixedRotation, &def.bullet, &def.enabled}) *flag = in->Get<bool>();
  return def;
}

void PutExact(const ExactBody& exact, Writer* out) {
  out->Put(*exact.pose);
  out->Put(*exact.velocity);
  out->Put(*exact.mass);
  out->Put(*exact.inertia);
  out->Put(static_cast<std::uint32_t>(exact.shapes.size()));
  for (const ExactShape& shape : exact.shapes) {
    out->Put(*shape.friction);
    out->Put(*shape.restitution);
    out->Put(static_cast<std::uint8_t>(shape.geometry.index()));
    std::visit(
        [out](const auto& geometry) {
          if constexpr (std::is_same_v<std::decay_t<decltype(geometry)>, PolygonGeometry>) {
            out->PutArray(geometry.vertices.data(), geometry.vertices.size());
          } else {
            out->Put(geometry);
          }
        },
        shape.geometry);
  }
}

ExactBody GetExact(Reader* in) {
  ExactBody exact;
  exact.pose = in->Get<Pose>();
  exact.velocity = in->Get<Twist>();
  exact.mass = in->Get<double>();
  exact.inertia = in->Get<double>();
  const auto count = in->Get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {
    ExactShape shape;
    shape.friction = in->Get<double>();
    shape.restitution = in->Get<double>();
    const auto kind = in->Get<std::uint8_t>();
    if (kind == 0) shape.geometry = in->Get<DiskGeometry>();
    if (kind == 1) shape.geometry = in->Get<SegmentGeometry>();
    if (kind == 2) shape.geometry = in->Get<HalfPlaneGeometry>();
    if (kind == 3) shape.geometry = PolygonGeometry{in->GetArray<Vec2>()};
    if (kind > 3) in->Fail("hold an exact shape of unknown kind");
    exact.shapes.push_back(std::move(shape));
  }
  return exact;
}

}  // namespace

void AppendBytes(const b2Body& body, std::int64_t id, const ExactBody& exact, const Wrench& added_load,
                 std::vector<std::byte>* bytes) {
  Writer out(bytes);
  out.Put(kMagic);
  out.Put(kVersion);
  out.Put(id);
  PutDefinition(body, &out);
  out.Put(NativeLoad(body, 1.0));
  b2MassData mass;
  body.GetMassData(&mass);
  out.Put(mass);
  PutExact(exact, &out);
  out.Put(added_load);
  std::vector<const b2Fixture*> fixtures;  // listed newest first
  for (const b2Fixture* f = body.GetFixtureList(); f != nullptr; f = f->GetNext()) fixtures.push_back(f);
  out.Put(static_cast<std::uint32_t>(fixtures.size()));
  std::for_each(fixtures.rbegin(), fixtures.rend(), [&out](const b2Fixture* f) { PutFixture(*f, &out); });
}

InsertedBody MakeBody(std::span<const std::byte> bytes, std::int64_t id, b2World* world) {
  Reader in(bytes, id);
  if (in.Get<std::uint32_t>() != kMagic || in.Get<std::uint32_t>() != kVersion) in.Fail("are of another kind or version");
  if (in.Get<std::int64_t>() != id) in.Fail("are of another body");
  const b2BodyDef def = GetDefinition(&in);
  const auto load = in.Get<Wrench>();
  const auto mass = in.Get<b2MassData>();
  InsertedBody inserted{nullptr, GetExact(&in), in.Get<Wrench>()};
  std::vector<Fixture> fixtures;
  for (auto count = in.Get<std::uint32_t>(); count > 0; --count) fixtures.push_back(GetFixture(&in));
  in.ExpectEnd();

  b2Body* body = inserted.body = world->CreateBody(&def);
  for (const Fixture& fixture : fixtures) body->CreateFixture(&fixture.def);
  b2MassData made;
  body->GetMassData(&made);
  if (made.mass != mass.mass || made.I != mass.I || !(made.center == mass.center)) body->SetMassData(&mass);
  if (load.fx != 0.0 || load.fy != 0.0)
    body->ApplyForceToCenter({static_cast<float>(load.fx), static_cast<float>(load.fy)}, true);
  if (load.torque != 0.0) body->ApplyTorque(static_cast<float>(load.torque), true);
  return inserted;
}

}  // namespace nscdd::box2d
