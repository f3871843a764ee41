// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd::box2d {

/// Shapes in double precision, in the frame of the body's centre of mass [m].
struct DiskGeometry {
  Vec2 centre;
  double radius = 0.0;
};
struct SegmentGeometry {
  Vec2 begin;
  Vec2 end;
};
/// All x with normal . x <= offset are solid. Stands for a (long) edge fixture; seen from the solid side the gap is negative.
struct HalfPlaneGeometry {
  Vec2 normal;
  double offset = 0.0;
};
/// Convex, counter-clockwise.
struct PolygonGeometry {
  std::vector<Vec2> vertices;
};

/// What is known of a fixture in double precision.
struct ExactShape {
  std::variant<DiskGeometry, SegmentGeometry, HalfPlaneGeometry, PolygonGeometry> geometry;
  std::optional<double> friction;     ///< [-] default: the fixture's float
  std::optional<double> restitution;  ///< [-] default: the fixture's float
};

/// What is known of a body in double precision, SI units. What is absent comes from the b2Body's floats.
struct ExactBody {
  std::optional<Pose> pose;        ///< of the centre of mass
  std::optional<Twist> velocity;   ///< of the centre of mass
  std::optional<double> mass;      ///< [kg]
  std::optional<double> inertia;   ///< [kg m^2] about the centre of mass
  std::vector<ExactShape> shapes;  ///< empty, or one per shape in order of shape number (see below), sensors included
};

}  // namespace nscdd::box2d
