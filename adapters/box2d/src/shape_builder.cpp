// SPDX-License-Identifier: Apache-2.0
#include "shape_builder.h"

#include <box2d/box2d.h>

#include <algorithm>

#include "wall.h"

namespace nscdd::box2d {
namespace {

/// From a vertex of Box2D's body frame to the frame of the centre of mass [m].
class Placer {
 public:
  Placer(const b2Body& body, double scale) : centre_(body.GetLocalCenter()), scale_(scale) {}
  Vec2 operator()(b2Vec2 vertex) const {
    return {scale_ * (static_cast<double>(vertex.x) - centre_.x), scale_ * (static_cast<double>(vertex.y) - centre_.y)};
  }

 private:
  b2Vec2 centre_;
  double scale_;
};

Shape ShapeOf(b2Fixture* fixture, ShapeKind kind) {
  const b2Filter& filter = fixture->GetFilterData();
  Shape shape;
  shape.fixture = fixture;
  shape.friction = fixture->GetFriction();
  shape.restitution = fixture->GetRestitution();
  shape.category = filter.categoryBits;
  shape.mask = filter.maskBits;
  shape.group = filter.groupIndex;
  shape.kind = fixture->IsSensor() || !fixture->GetBody()->IsEnabled() ? ShapeKind::kNone : kind;
  return shape;
}

void AddCircle(b2Fixture* fixture, const Placer& place, double scale, std::vector<ShapeDraft>* drafts) {
  const auto& circle = static_cast<const b2CircleShape&>(*fixture->GetShape());
  ShapeDraft draft{ShapeOf(fixture, ShapeKind::kDisk), {}};
  draft.shape.centre = place(circle.m_p);
  draft.shape.radius = scale * circle.m_radius;
  drafts->push_back(std::move(draft));
}

void AddSegment(b2Fixture* fixture, Vec2 begin, Vec2 end, std::vector<ShapeDraft>* drafts) {
  drafts->push_back({ShapeOf(fixture, ShapeKind::kSegment), MakeSegment(begin, end)});
}

void AddPolygon(b2Fixture* fixture, const Placer& place, std::vector<ShapeDraft>* drafts) {
  const auto& polygon = static_cast<const b2PolygonShape&>(*fixture->GetShape());
  std::vector<Vec2> points;
  for (int i = 0; i < polygon.m_count; ++i) points.push_back(place(polygon.m_vertices[i]));
  drafts->push_back({ShapeOf(fixture, ShapeKind::kPolygon), MakePolygon(std::move(points))});
}

void AddFixture(b2Fixture* fixture, const Placer& place, double scale, std::vector<ShapeDraft>* drafts) {
  switch (fixture->GetType()) {
    case b2Shape::e_circle:
      AddCircle(fixture, place, scale, drafts);
      break;
    case b2Shape::e_edge: {
      const auto& edge = static_cast<const b2EdgeShape&>(*fixture->GetShape());
      AddSegment(fixture, place(edge.m_vertex1), place(edge.m_vertex2), drafts);
      break;
    }
    case b2Shape::e_chain: {
      const auto& chain = static_cast<const b2ChainShape&>(*fixture->GetShape());
      for (int i = 0; i + 1 < chain.m_count; ++i) {
        AddSegment(fixture, place(chain.m_vertices[i]), place(chain.m_vertices[i + 1]), drafts);
      }
      break;
    }
    default:
      AddPolygon(fixture, place, drafts);
  }
}

}  // namespace

std::vector<ShapeDraft> DraftShapes(const b2Body& body, double scale) {
  std::vector<b2Fixture*> fixtures;  // Box2D lists the newest first
  for (const b2Fixture* f = body.GetFixtureList(); f != nullptr; f = f->GetNext())
    fixtures.push_back(const_cast<b2Fixture*>(f));
  std::reverse(fixtures.begin(), fixtures.end());
  std::vector<ShapeDraft> drafts;
  const Placer place(body, scale);
  for (b2Fixture* fixture : fixtures) AddFixture(fixture, place, scale, &drafts);
  return drafts;
}

ExactShape ExactOf(const Shape& shape, const Wall* wall) {
  ExactShape exact;
  exact.friction = shape.friction;
  exact.restitution = shape.restitution;
  if (wall == nullptr) {
    exact.geometry = DiskGeometry{shape.centre, shape.radius};
  } else if (wall->points.empty()) {
    exact.geometry = HalfPlaneGeometry{wall->normals[0], wall->offset};
  } else if (wall->normals.size() == 1) {
    exact.geometry = SegmentGeometry{wall->points[0], wall->points[1]};
  } else {
    exact.geometry = PolygonGeometry{wall->points};
  }
  return exact;
}

}  // namespace nscdd::box2d
