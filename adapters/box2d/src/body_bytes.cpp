#include "body_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>

#include "host_body.h"
#include "nscdd/error.h"

namespace nscdd::box2d {
namespace {

constexpr std::uint32_t kMagic = 0x4232444E;  // "ND2B"
constexpr std::uint32_t kVersion = 1;

class Writer {
 public:
  explicit Writer(std::vector<std::byte>* bytes) : bytes_(bytes) {}
  template <typename T>
    requires std::is_trivially_copyable_v<T>
  void Put(const T& value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_->insert(bytes_->end(), first, first + sizeof(T));
  }
  template <typename T>
  void PutArray(const T* values, std::size_t count) {
    Put(static_cast<std::uint32_t>(count));
    for (std::size_t i = 0; i < count; ++i) Put(values[i]);
  }

 private:
  std::vector<std::byte>* bytes_;
};

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, std::int64_t id) : bytes_(bytes), id_(id) {}
  template <typename T>
    requires std::is_trivially_copyable_v<T>
  T Get() {
    if (bytes_.size() < sizeof(T)) Fail("end too early");
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  template <typename T>
  std::vector<T> GetArray() {
    const auto count = Get<std::uint32_t>();
    if (bytes_.size() < std::size_t{count} * sizeof(T)) Fail("end too early");
    std::vector<T> values(count);
    for (T& value : values) value = Get<T>();
    return values;
  }
  void ExpectEnd() const {
    if (!bytes_.empty()) Fail("go on behind the end");
  }
  [[noreturn]] void Fail(const char* what) const {
    throw Error(fmt::format("The bytes for Box2D body {} {}: give Insert exactly what Pack of this version wrote.", id_, what));
  }

 private:
  std::span<const std::byte> bytes_;
  std::int64_t id_;
};

void PutShape(const b2Shape& shape, Writer* out) {
  out->Put(static_cast<std::uint8_t>(shape.GetType()));
  out->Put(shape.m_radius);
  switch (shape.GetType()) {
    case b2Shape::e_circle:
      out->Put(static_cast<const b2CircleShape&>(shape).m_p);
      break;
    case b2Shape::e_edge: {
      const auto& edge = static_cast<const b2EdgeShape&>(shape);
      for (const b2Vec2 v : {edge.m_vertex0, edge.m_vertex1, edge.m_vertex2, edge.m_vertex3}) out->Put(v);
      out->Put(edge.m_oneSided);
      break;
    }
    case b2Shape::e_chain: {
      const auto& chain = static_cast<const b2ChainShape&>(shape);
      out->PutArray(chain.m_vertices, static_cast<std::size_t>(chain.m_count));
      out->Put(chain.m_prevVertex);
      out->Put(chain.m_nextVertex);
      break;
    }
    default: {
      const auto& polygon = static_cast<const b2PolygonShape&>(shape);
      out->PutArray(polygon.m_vertices, static_cast<std::size_t>(polygon.m_count));
      out->PutArray(polygon.m_normals, static_cast<std::size_t>(polygon.m_count));
      out->Put(polygon.m_centroid);
    }
  }
}

std::unique_ptr<b2Shape> GetEdge(Reader* in) {
  auto edge = std::make_unique<b2EdgeShape>();
  for (b2Vec2* v : {&edge->m_vertex0, &edge->m_vertex1, &edge->m_vertex2, &edge->m_vertex3}) *v = in->Get<b2Vec2>();
  edge->m_oneSided = in->Get<bool>();
  return edge;
}

std::unique_ptr<b2Shape> GetChain(Reader* in) {
  auto chain = std::make_unique<b2ChainShape>();
  const auto vertices = in->GetArray<b2Vec2>();
  const auto previous = in->Get<b2Vec2>(), next = in->Get<b2Vec2>();
  if (vertices.size() < 2) in->Fail("hold a chain without an edge");
  chain->CreateChain(vertices.data(), static_cast<std::int32_t>(vertices.size()), previous, next);
  return chain;
}

std::unique_ptr<b2Shape> GetPolygon(Reader* in) {
  auto polygon = std::make_unique<b2PolygonShape>();
  const auto vertices = in->GetArray<b2Vec2>(), normals = in->GetArray<b2Vec2>();
  if (vertices.size() < 3 || vertices.size() > b2_maxPolygonVertices || normals.size() != vertices.size()) {
    in->Fail("hold a polygon that Box2D does not allow");
  }
  std::copy(vertices.begin(), vertices.end(), polygon->m_vertices);
  std::copy(normals.begin(), normals.end(), polygon->m_normals);
  polygon->m_count = static_cast<std::int32_t>(vertices.size());
  polygon->m_centroid = in->Get<b2Vec2>();
  return polygon;
}

std::unique_ptr<b2Shape> GetShape(Reader* in) {
  const auto type = in->Get<std::uint8_t>();
  const auto radius = in->Get<float>();
  std::unique_ptr<b2Shape> shape;
  if (type == b2Shape::e_circle) {
    auto circle = std::make_unique<b2CircleShape>();
    circle->m_p = in->Get<b2Vec2>();
    shape = std::move(circle);
  } else if (type == b2Shape::e_edge) {
    shape = GetEdge(in);
  } else if (type == b2Shape::e_chain) {
    shape = GetChain(in);
  } else if (type == b2Shape::e_polygon) {
    shape = GetPolygon(in);
  } else {
    in->Fail("hold a shape of unknown type");
  }
  shape->m_radius = radius;
  return shape;
}

/// A fixture without its body.
struct Fixture {
  std::unique_ptr<b2Shape> shape;
  b2FixtureDef def;
};

void PutFixture(const b2Fixture& fixture, Writer* out) {
  out->Put(fixture.GetFriction());
  out->Put(fixture.GetRestitution());
  out->Put(fixture.GetRestitutionThreshold());
  out->Put(fixture.GetDensity());
  out->Put(fixture.IsSensor());
  out->Put(fixture.GetFilterData().categoryBits);
  out->Put(fixture.GetFilterData().maskBits);
  out->Put(fixture.GetFilterData().groupIndex);
  PutShape(*fixture.GetShape(), out);
}

Fixture GetFixture(Reader* in) {
  Fixture fixture;
  fixture.def.friction = in->Get<float>();
  fixture.def.restitution = in->Get<float>();
  fixture.def.restitutionThreshold = in->Get<float>();
  fixture.def.density = in->Get<float>();
  fixture.def.isSensor = in->Get<bool>();
  fixture.def.filter.categoryBits = in->Get<std::uint16_t>();
  fixture.def.filter.maskBits = in->Get<std::uint16_t>();
  fixture.def.filter.groupIndex = in->Get<std::int16_t>();
  fixture.shape = GetShape(in);
  fixture.def.shape = fixture.shape.get();
  return fixture;
}

void PutDefinition(const b2Body& body, Writer* out) {
  out->Put(static_cast<std::int32_t>(body.GetType()));
  out->Put(body.GetPosition());
  out->Put(body.GetAngle());
  out->Put(body.GetLinearVelocity());
  out->Put(body.GetAngularVelocity());
  out->Put(body.GetLinearDamping());
  out->Put(body.GetAngularDamping());
  out->Put(body.GetGravityScale());
  for (const bool flag : {body.IsSleepingAllowed(), body.IsAwake(), body.IsFixedRotation(), body.IsBullet(), body.IsEnabled()}) {
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
  std::vector<Fixture> fixtures(in.Get<std::uint32_t>());
  for (Fixture& fixture : fixtures) fixture = GetFixture(&in);
  in.ExpectEnd();

  b2Body* body = inserted.body = world->CreateBody(&def);
  for (Fixture& fixture : fixtures) {
    fixture.def.shape = fixture.shape.get();
    body->CreateFixture(&fixture.def);
  }
  b2MassData made;
  body->GetMassData(&made);
  if (made.mass != mass.mass || made.I != mass.I || !(made.center == mass.center)) body->SetMassData(&mass);
  if (load.fx != 0.0 || load.fy != 0.0) body->ApplyForceToCenter({static_cast<float>(load.fx), static_cast<float>(load.fy)}, true);
  if (load.torque != 0.0) body->ApplyTorque(static_cast<float>(load.torque), true);
  return inserted;
}

}  // namespace nscdd::box2d
