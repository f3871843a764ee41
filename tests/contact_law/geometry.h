// SPDX-License-Identifier: Apache-2.0
// The geometry by which the bars judge. It shares no line with the adapters' own.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd::contact_law {

struct Circle {
  Vec2 centre;
  double radius = 0.0;  ///< [m]
};
/// From `a` to `b`: no thickness, two sides.
struct Line {
  Vec2 a;
  Vec2 b;
};
/// normal . x <= offset is solid.
struct Plane {
  Vec2 normal{0.0, 1.0};
  double offset = 0.0;
};
/// Convex, counter-clockwise, solid.
struct Polygon {
  std::vector<Vec2> vertices;
};

inline Vec2 InFrameOf(const Pose& pose, Vec2 point) { return Rotate(-pose.angle, point - Centre(pose)); }
inline Vec2 InWorld(const Pose& pose, Vec2 point) { return Centre(pose) + Rotate(pose.angle, point); }
inline Pose Between(const Pose& from, const Pose& to, double t) {
  return {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.angle + t * (to.angle - from.angle)};
}

/// Distance of a point from the shape; negative inside of solid ones.
inline double Distance(Vec2 p, const Line& line) {
  const Vec2 along = line.b - line.a;
  const double t = std::clamp(Dot(p - line.a, along) / Dot(along, along), 0.0, 1.0);
  return Norm(p - (line.a + t * along));
}
inline double Distance(Vec2 p, const Plane& plane) { return Dot(plane.normal, p) - plane.offset; }
inline double Distance(Vec2 p, const Circle& circle) { return Norm(p - circle.centre) - circle.radius; }
inline double Distance(Vec2 p, const Polygon& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vec2 a = polygon.vertices[i], b = polygon.vertices[(i + 1) % polygon.vertices.size()];
    nearest = std::min(nearest, Distance(p, Line{a, b}));
    inside = inside && Cross(b - a, p - a) > 0.0;
  }
  return inside ? -nearest : nearest;
}

/// Whether a point that goes straight from `from` to `to` passes through the shape.
inline bool Passes(Vec2 from, Vec2 to, const Line& line) {
  const Vec2 path = to - from, along = line.b - line.a;
  return Cross(along, from - line.a) * Cross(along, to - line.a) < 0.0 &&
         Cross(path, line.a - from) * Cross(path, line.b - from) < 0.0;
}
inline bool Passes(Vec2, Vec2 to, const Plane& plane) { return Distance(to, plane) < 0.0; }
inline bool Passes(Vec2 from, Vec2 to, const Circle& circle) {
  return from.x == to.x && from.y == to.y ? Distance(to, circle) < 0.0
                                          : Distance(circle.centre, Line{from, to}) < circle.radius;
}
inline bool Passes(Vec2 from, Vec2 to, const Polygon& polygon) {
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    if (Passes(from, to, Line{polygon.vertices[i], polygon.vertices[(i + 1) % polygon.vertices.size()]})) return true;
  }
  return Distance(to, polygon) < 0.0;
}

/// Time in [0, infinity) at which |x + t v| falls to `distance`; infinity if it never does. |x| > distance.
inline double TimeOfMeeting(Vec2 x, Vec2 v, double distance) {
  const double a = Dot(v, v), b = Dot(x, v), c = Dot(x, x) - distance * distance, root = b * b - a * c;
  if (b >= 0.0 || root < 0.0) return std::numeric_limits<double>::infinity();
  return c / (-b + std::sqrt(root));
}

}  // namespace nscdd::contact_law
