// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nscdd/vector.h"

namespace nscdd::reference {

/// A segment, or a half-plane, at its place in the world.
struct PlacedWall {
  bool is_segment = false;
  Vec2 a;               ///< segment: its beginning
  Vec2 b;               ///< segment: its end
  Vec2 normal;          ///< half-plane: into the free side; segment: to the left of a -> b
  double offset = 0.0;  ///< half-plane: distance of its surface from the body's centre
  Vec2 centre;          ///< of the body
  std::int32_t row = 0;
  std::int32_t shape = 0;
  double sweep = 0.0;  ///< [m] that turning moves it beyond its body's reach, which knows no half-planes
};

/// The point of a wall that is closest to a disk's centre.
struct WallPoint {
  Vec2 point;
  Vec2 normal;            ///< unit, from the wall to the disk's centre
  double distance = 0.0;  ///< [m] >= 0, but behind a half-plane
  bool is_end = false;    ///< a corner
};

/// `disk` is the centre as seen by the wall (shifted by periods). Points closer than `tolerance` [m] to an end of a segment are
/// the end.
WallPoint ClosestPoint(const PlacedWall& wall, Vec2 disk, double tolerance);

/// The point of the segment's whole line instead, from the side that `side` leads to.
WallPoint PointOfLine(const PlacedWall& segment, Vec2 disk, Vec2 side);

}  // namespace nscdd::reference
