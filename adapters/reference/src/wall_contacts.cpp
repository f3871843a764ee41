// SPDX-License-Identifier: Apache-2.0
#include "wall_contacts.h"

#include <cmath>

namespace nscdd::reference {

WallPoint ClosestPoint(const PlacedWall& segment, Vec2 disk, double tolerance) {
  if (!segment.is_segment) {
    const double distance = Dot(segment.normal, disk - segment.centre) - segment.offset;
    return {disk - distance * segment.normal, segment.normal, distance, false};
  }
  const Vec2 along = segment.b - segment.a, from_a = disk - segment.a;
  const double length = Norm(along);
  const double s = Dot(from_a, along) / length;
  WallPoint closest;
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

WallPoint PointOfLine(const PlacedWall& segment, Vec2 disk, Vec2 side) {
  const Vec2 normal = Dot(segment.normal, side) < 0.0 ? -1.0 * segment.normal : segment.normal;
  const double distance = Dot(normal, disk - segment.a);
  return {disk - distance * normal, normal, distance, false};
}

}  // namespace nscdd::reference
