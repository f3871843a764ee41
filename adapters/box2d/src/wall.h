// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape.h"

namespace nscdd::box2d {

/// Where a wall is closest to a point, in the frame of the wall's body.
struct WallPoint {
  Vec2 point;             // on the wall
  Vec2 normal;            // unit, from the wall to the point asked for
  double distance = 0.0;  // [m] < 0 inside a polygon or half-plane
  bool is_corner = false;
};

Wall MakeSegment(Vec2 begin, Vec2 end);
Wall MakeHalfPlane(Vec2 normal, double offset);
/// Counter-clockwise, convex.
Wall MakePolygon(std::vector<Vec2> points);

/// `tolerance` [m]: points of a segment closer than this to an end are the end.
WallPoint ClosestPoint(ShapeKind kind, const Wall& wall, Vec2 from, double tolerance);

/// The point of the segment's whole line instead, from the side that `side` leads to.
WallPoint PointOfLine(const Wall& segment, Vec2 from, Vec2 side);

}  // namespace nscdd::box2d
