// SPDX-License-Identifier: Apache-2.0
// Double-precision shapes in place of the fixtures' floats, checked against them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nscdd/error.h"
#include "shape_builder.h"
#include "wall.h"

namespace nscdd::box2d {
namespace {

/// How far an exact point may lie from the fixture's: what floats and a little care lose.
constexpr double kTolerance = 1e-4;

struct Context {
  std::int64_t id;
  std::size_t number;
};

void CheckPoint(Context at, const char* what, Vec2 exact, Vec2 fixture, double size) {
  const double distance = Norm(exact - fixture);
  if (distance <= kTolerance * size) return;
  throw Error(
      fmt::format("The exact shape {} of Box2D body {} has {} at ({}, {}) and its fixture at ({}, {}) from the centre of mass "
                  "[m]: they must describe the same shape, check metres_per_unit and the order of the fixtures.",
                  at.number, at.id, what, exact.x, exact.y, fixture.x, fixture.y));
}

[[noreturn]] void ThrowKind(Context at) {
  throw Error(
      fmt::format("The exact shape {} of Box2D body {} is of another kind than its fixture: give a disk for a circle, a "
                  "segment or half-plane for an edge or a child of a chain, a polygon for a polygon.",
                  at.number, at.id));
}

void Replace(Context at, const DiskGeometry& disk, ShapeDraft* draft) {
  if (!draft->wall.normals.empty()) ThrowKind(at);
  Shape& shape = draft->shape;
  if (!(std::abs(disk.radius - shape.radius) <= kTolerance * disk.radius)) {
    throw Error(
        fmt::format("The exact shape {} of Box2D body {} has radius {} m and its fixture {} m: they must describe the same "
                    "disk, check metres_per_unit and the order of the fixtures.",
                    at.number, at.id, disk.radius, shape.radius));
  }
  CheckPoint(at, "its centre", disk.centre, shape.centre, disk.radius + Norm(disk.centre));
  shape.centre = disk.centre;
  shape.radius = disk.radius;
}

void Replace(Context at, const SegmentGeometry& segment, ShapeDraft* draft) {
  if (draft->wall.points.size() != 2) ThrowKind(at);
  const double size = std::max({Norm(segment.begin), Norm(segment.end), Norm(segment.end - segment.begin)});
  CheckPoint(at, "its begin", segment.begin, draft->wall.points[0], size);
  CheckPoint(at, "its end", segment.end, draft->wall.points[1], size);
  draft->wall = MakeSegment(segment.begin, segment.end);
}

void Replace(Context at, const HalfPlaneGeometry& plane, ShapeDraft* draft) {
  if (draft->wall.points.size() != 2 || !(Norm(plane.normal) > 0.0)) ThrowKind(at);
  const Wall wall = MakeHalfPlane(plane.normal, plane.offset);
  for (const Vec2 end : draft->wall.points) {
    const Vec2 foot = end - (Dot(wall.normals[0], end) - wall.offset) * wall.normals[0];
    CheckPoint(at, "its surface", foot, end, Norm(draft->wall.points[1] - draft->wall.points[0]));
  }
  draft->wall = wall;
  if (draft->shape.kind == ShapeKind::kSegment) draft->shape.kind = ShapeKind::kHalfPlane;
}

void Replace(Context at, const PolygonGeometry& polygon, ShapeDraft* draft) {
  if (draft->wall.points.size() < 3 || draft->wall.points.size() != polygon.vertices.size()) ThrowKind(at);
  double size = 0.0;
  for (const Vec2 vertex : polygon.vertices) size = std::max(size, Norm(vertex));
  // b2PolygonShape::Set begins with a vertex of its own choice.
  std::vector<Vec2> vertices = polygon.vertices;
  const Vec2 first = draft->wall.points[0];
  const auto begin =
      std::min_element(vertices.begin(), vertices.end(), [first](Vec2 a, Vec2 b) { return Norm(a - first) < Norm(b - first); });
  std::rotate(vertices.begin(), begin, vertices.end());
  for (std::size_t i = 0; i < vertices.size(); ++i) CheckPoint(at, "a vertex", vertices[i], draft->wall.points[i], size);
  draft->wall = MakePolygon(std::move(vertices));
}

}  // namespace

void ApplyExact(const std::vector<ExactShape>& exact, std::int64_t id, std::vector<ShapeDraft>* drafts) {
  if (exact.empty()) return;
  if (exact.size() != drafts->size()) {
    throw Error(
        fmt::format("Box2D body {} was assigned {} exact shapes and has {} (one per fixture, one per child of a chain): give "
                    "all of them, or none.",
                    id, exact.size(), drafts->size()));
  }
  for (std::size_t i = 0; i < exact.size(); ++i) {
    ShapeDraft& draft = (*drafts)[i];
    std::visit([&](const auto& geometry) { Replace({id, i}, geometry, &draft); }, exact[i].geometry);
    draft.shape.friction = exact[i].friction.value_or(draft.shape.friction);
    draft.shape.restitution = exact[i].restitution.value_or(draft.shape.restitution);
  }
}

}  // namespace nscdd::box2d
