// SPDX-License-Identifier: Apache-2.0
#include "fixture_bytes.h"

#include <algorithm>
#include <utility>

namespace nscdd::box2d {
namespace {

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

}  // namespace

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

}  // namespace nscdd::box2d
