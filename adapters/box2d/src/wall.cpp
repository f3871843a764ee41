// SPDX-License-Identifier: Apache-2.0
#include "wall.h"

#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace nscdd::box2d {
namespace {

Vec2 LeftNormal(Vec2 begin, Vec2 end) {
  const Vec2 along = end - begin;
  const double length = Norm(along);
  return {-along.y / length, along.x / length};
}

WallPoint Corner(Vec2 corner, Vec2 from, Vec2 normal_if_coincident) {
  const Vec2 d = from - corner;
  const double distance = std::sqrt(Dot(d, d));
  return {corner, distance > 0.0 ? (1.0 / distance) * d : normal_if_coincident, distance, true};
}

/// Two-sided and without thickness: the normal points to the side where `from` is (to the left when it is on the line).
WallPoint OfSegment(const Wall& wall, Vec2 from, double tolerance) {
  const Vec2 begin = wall.points[0], end = wall.points[1], left = wall.normals[0];
  const Vec2 from_begin = from - begin;
  const double length = Norm(end - begin);
  const double s = Dot(from_begin, {left.y, -left.x});
  if (s <= tolerance || s >= length - tolerance) return Corner(s <= 0.5 * length ? begin : end, from, left);
  const double height = Dot(left, from_begin);
  const Vec2 normal = height < 0.0 ? -1.0 * left : left;
  return {from - std::abs(height) * normal, normal, std::abs(height), false};
}

/// Solid: outside the nearest side or corner, inside the nearest side with a negative distance.
WallPoint OfPolygon(const Wall& wall, Vec2 from) {
  const std::size_t count = wall.points.size();
  std::size_t side = 0;
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double h = Dot(wall.normals[i], from - wall.points[i]);
    if (h > height) std::tie(height, side) = std::pair(h, i);
  }
  const Vec2 normal = wall.normals[side], begin = wall.points[side], end = wall.points[(side + 1) % count];
  const Vec2 along{-normal.y, normal.x};
  if (height > 0.0 && Dot(from - begin, along) < 0.0) return Corner(begin, from, normal);
  if (height > 0.0 && Dot(from - end, along) > 0.0) return Corner(end, from, normal);
  return {from - height * normal, normal, height, false};
}

}  // namespace

Wall MakeSegment(Vec2 begin, Vec2 end) { return {{begin, end}, {LeftNormal(begin, end)}, 0.0}; }

Wall MakeHalfPlane(Vec2 normal, double offset) {
  const double length = Norm(normal);
  if (length == 1.0) return {{}, {normal}, offset};
  return {{}, {(1.0 / length) * normal}, offset / length};
}

Wall MakePolygon(std::vector<Vec2> points) {
  Wall wall{std::move(points), {}, 0.0};
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    wall.normals.push_back(-1.0 * LeftNormal(wall.points[i], wall.points[(i + 1) % wall.points.size()]));
  }
  return wall;
}

WallPoint PointOfLine(const Wall& segment, Vec2 from, Vec2 side) {
  const Vec2 left = segment.normals[0], normal = Dot(left, side) < 0.0 ? -1.0 * left : left;
  const double distance = Dot(normal, from - segment.points[0]);
  return {from - distance * normal, normal, distance, false};
}

WallPoint ClosestPoint(ShapeKind kind, const Wall& wall, Vec2 from, double tolerance) {
  if (kind == ShapeKind::kSegment) return OfSegment(wall, from, tolerance);
  if (kind == ShapeKind::kPolygon) return OfPolygon(wall, from);
  const double distance = Dot(wall.normals[0], from) - wall.offset;
  return {from - distance * wall.normals[0], wall.normals[0], distance, false};
}

}  // namespace nscdd::box2d
