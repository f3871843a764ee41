// SPDX-License-Identifier: Apache-2.0
#include "wall_contacts.h"

#include <cmath>

namespace nscdd::reference {

SegmentPoint ClosestPoint(const PlacedWall& segment, Vec2 disk, double tolerance) {
  const Vec2 along = segment.b - segment.a, from_a = disk - segment.a;
  const double length = Norm(along);
  const double s = Dot(from_a, along) / length;
  SegmentPoint closest;
  closest.is_end = s <= tolerance || s >= length - tolerance;
  if (!closest.is_end) {
    const double height = Dot(segment.normal, from_a);
    closest.normal = height < 0.0 ? -1.0 * segment.normal : segment.normal;
    closest.distance = std::abs(height);
    closest.point = disk - closest.distance * closest.normal;
    return closest;
  }
  closest.point = s <= 0.5 * length ? segment.a : segment.b;
  const Vec2 to_disk = disk - closest.point;
  closest.distance = Norm(to_disk);
  closest.normal = closest.distance > 0.0 ? (1.0 / closest.distance) * to_disk : segment.normal;
  return closest;
}

}  // namespace nscdd::reference
