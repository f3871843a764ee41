// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/vector.h"

class b2Fixture;

namespace nscdd::box2d {

enum class ShapeKind : std::uint8_t {
  kNone,  ///< a sensor or a shape of a disabled body: keeps its number and touches nothing
  kDisk,
  kSegment,
  kHalfPlane,
  kPolygon,
};

/// One shape of a body, in the frame of its centre of mass [m].
struct Shape {
  Vec2 centre;          // of a disk
  double radius = 0.0;  // of a disk
  double friction = 0.0;
  double restitution = 0.0;
  b2Fixture* fixture = nullptr;
  std::int32_t body = -1;  // slot in the BodyStore; -1: the entry is unused
  std::int32_t wall = -1;  // index into the BodyStore's walls, -1 for disks
  std::uint16_t category = 1;
  std::uint16_t mask = 0xFFFF;
  std::int16_t group = 0;
  ShapeKind kind = ShapeKind::kNone;
};

/// What a segment, half-plane or polygon has beyond a Shape, in the frame of its body.
struct Wall {
  std::vector<Vec2> points;  // segment: both ends; polygon: counter-clockwise
  std::vector<Vec2>
      normals;          // unit; segment: to the left of its direction; half-plane: out of the solid; polygon: one per side
  double offset = 0.0;  // of a half-plane: solid where normal . x <= offset
};

}  // namespace nscdd::box2d
