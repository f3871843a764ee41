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
};

/// The point of a segment that is closest to a disk's centre.
struct SegmentPoint {
  Vec2 point;
  Vec2 normal;            ///< unit, from the segment to the disk's centre
  double distance = 0.0;  ///< [m] >= 0
  bool is_end = false;    ///< a corner
};

/// `disk` is the centre as seen by the segment (shifted by periods). Points closer than `tolerance` [m] to an end are the end.
SegmentPoint ClosestPoint(const PlacedWall& segment, Vec2 disk, double tolerance);

}  // namespace nscdd::reference
