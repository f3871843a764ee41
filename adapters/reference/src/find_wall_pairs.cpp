// SPDX-License-Identifier: Apache-2.0
// The part of ContactDetector that finds disks near segments and half-planes.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "contact_detector.h"

namespace nscdd::reference {
namespace {

std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

double ContactDetector::JoinTolerance(const PlacedDisk& disk) const {
  return 1e-9 * disk.radius + 1e-14 * (std::abs(disk.centre.x) + std::abs(disk.centre.y) + period_);
}

void ContactDetector::PlaceWalls(const Body& body, const Pose& q, std::int32_t row) {
  auto shape = static_cast<std::int32_t>(body.disks.size());
  PlacedWall wall;
  wall.centre = Centre(q);
  wall.row = row;
  wall.is_segment = true;
  for (const Segment& segment : body.segments) {
    const Vec2 a = Rotate(q.angle, segment.a), b = Rotate(q.angle, segment.b), along = b - a;
    wall.a = wall.centre + a;
    wall.b = wall.centre + b;
    wall.normal = (1.0 / Norm(along)) * Vec2{-along.y, along.x};
    wall.shape = shape++;
    walls_.push_back(wall);
  }
  wall.is_segment = false;
  for (const HalfPlane& plane : body.half_planes) {
    wall.normal = Rotate(q.angle, plane.normal);
    wall.offset = plane.offset;
    wall.shape = shape++;
    walls_.push_back(wall);
  }
}

void ContactDetector::FindWallPairs(double alert) {
  hits_.clear();
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    walls_[i].is_segment ? FindSegmentHits(walls_[i], index, alert) : FindHalfPlanePairs(walls_[i], index, alert);
  }
  AddSegmentPairs();
}

void ContactDetector::FindHalfPlanePairs(const PlacedWall& wall, std::int32_t index, double alert) {
  for (std::size_t i = 0; i < disks_.size(); ++i) {
    const PlacedDisk& disk = disks_[i];
    const double height = Dot(wall.normal, disk.centre - wall.centre) - wall.offset;
    if (height - disk.radius <= alert && Touchable(disk.row, wall.row)) AddWallPair(static_cast<std::int32_t>(i), index, 0);
  }
}

void ContactDetector::FindSegmentHits(const PlacedWall& wall, std::int32_t index, double alert) {
  for (auto& [size, size_class] : classes_) {
    const double reach = size_class.max_radius + alert + slack_;
    std::int32_t first = 0, last = 0;  // images of the segment within reach of the wrapped disks
    if (period_ > 0.0) {
      first = static_cast<std::int32_t>(std::ceil((period_origin_ - reach - std::max(wall.a.x, wall.b.x)) / period_));
      last = static_cast<std::int32_t>(std::floor((period_origin_ + period_ + reach - std::min(wall.a.x, wall.b.x)) / period_));
    }
    for (std::int32_t image = first; image <= last; ++image) {
      const Vec2 shift{image * period_, 0.0};
      size_class.grid.VisitBand(wall.a + shift, wall.b + shift, reach, [&](const GridEntry& entry) {
        const PlacedDisk& disk = disks_[Index(entry.disk)];
        if (entry.is_copy || !Touchable(disk.row, wall.row)) return;
        const std::int32_t seen = image - entry.shift;
        const Vec2 centre{disk.centre.x - seen * period_, disk.centre.y};
        const SegmentPoint closest = ClosestPoint(wall, centre, JoinTolerance(disk));
        if (closest.distance - disk.radius <= alert) hits_.push_back({entry.disk, index, seen, closest});
      });
    }
  }
}

/// Where hits of one disk on one body meet in a corner, a flat side takes it, else the segment with the smallest number.
bool ContactDetector::IsTaken(const WallHit& hit, std::span<const WallHit> of_disk) const {
  if (!hit.closest.is_end) return false;
  const double tolerance = JoinTolerance(disks_[Index(hit.disk)]);
  for (const WallHit& other : of_disk) {
    const PlacedWall& segment = walls_[Index(other.wall)];
    if (&other == &hit || segment.row != walls_[Index(hit.wall)].row) continue;
    const Vec2 corner{hit.closest.point.x + (hit.image - other.image) * period_, hit.closest.point.y};
    const bool joined = Norm(segment.a - corner) <= tolerance || Norm(segment.b - corner) <= tolerance;
    const bool same_corner = other.closest.is_end && Norm(other.closest.point - corner) <= tolerance;
    if (joined && (!other.closest.is_end || (same_corner && &other < &hit))) return true;
  }
  return false;
}

void ContactDetector::AddSegmentPairs() {
  std::sort(hits_.begin(), hits_.end(), [](const WallHit& p, const WallHit& q) {
    return std::tie(p.disk, p.wall, p.image) < std::tie(q.disk, q.wall, q.image);
  });
  for (std::size_t begin = 0, end = 0; begin < hits_.size(); begin = end) {
    while (end < hits_.size() && hits_[end].disk == hits_[begin].disk) ++end;
    const std::span<const WallHit> of_disk(hits_.data() + begin, end - begin);
    for (const WallHit& hit : of_disk) {
      if (!IsTaken(hit, of_disk)) AddWallPair(hit.disk, hit.wall, hit.image);
    }
  }
}

void ContactDetector::AddWallPair(std::int32_t disk, std::int32_t wall, std::int32_t image) {
  const PlacedDisk& d = disks_[Index(disk)];
  const PlacedWall& w = walls_[Index(wall)];
  if (d.row < w.row) {
    candidates_.push_back({d.row, w.row, d.shape, w.shape, image, disk, -1 - wall});
  } else {
    candidates_.push_back({w.row, d.row, w.shape, d.shape, -image, -1 - wall, disk});
  }
}

}  // namespace nscdd::reference
