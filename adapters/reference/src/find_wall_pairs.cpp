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
    wall.sweep = body.half_planes.empty() ? 0.0 : std::abs(rows_[Index(row)].turn) * std::max(Norm(a), Norm(b));
    walls_.push_back(wall);
  }
  wall.is_segment = false;
  wall.sweep = 0.0;
  for (const HalfPlane& plane : body.half_planes) {
    wall.normal = Rotate(q.angle, plane.normal);
    wall.offset = plane.offset;
    wall.shape = shape++;
    walls_.push_back(wall);
  }
}

ContactDetector::WallMeeting ContactDetector::MeetingOf(const PlacedDisk& disk, const PlacedWall& wall, Vec2 seen,
                                                        double tolerance) const {
  const Row &body = rows_[Index(disk.row)], &of_wall = rows_[Index(wall.row)];
  WallMeeting meeting;
  meeting.seen = seen;
  if (motion_ != nullptr) {
    meeting.way = {
        seen - wall.centre - disk.arm, body.move - of_wall.move, {}, disk.arm, 0.0, body.turn, of_wall.turn, disk.radius};
    meeting.moment = ShapeMeeting(meeting.way, [&](Vec2 x) { return ClosestPoint(wall, wall.centre + x, tolerance); });
  }
  meeting.closest = ClosestPoint(wall, meeting.SeenAt(meeting.moment, wall), tolerance);
  return meeting;
}

void ContactDetector::FindWallPairs() {
  hits_.clear();
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    walls_[i].is_segment ? FindSegmentHits(walls_[i], index) : FindHalfPlanePairs(walls_[i], index);
  }
  AddSegmentPairs();
}

void ContactDetector::FindHalfPlanePairs(const PlacedWall& wall, std::int32_t index) {
  for (std::size_t i = 0; i < disks_.size(); ++i) {
    const PlacedDisk& disk = disks_[i];
    const double height = Dot(wall.normal, disk.centre - wall.centre) - wall.offset;
    // A half-plane that turns sweeps further the further away: any disk may be the one.
    const bool is_far = height - disk.radius > ReachOf(disk.row, wall.row) && rows_[Index(wall.row)].turn == 0.0;
    if (is_far || !Touchable(disk.row, wall.row)) continue;
    const WallMeeting meeting = MeetingOf(disk, wall, disk.centre, 0.0);
    if (meeting.closest.distance - disk.radius > ReachOf(disk.row, wall.row)) continue;
    hits_.push_back({static_cast<std::int32_t>(i), index, 0, meeting});
  }
}

void ContactDetector::FindSegmentHits(const PlacedWall& wall, std::int32_t index) {
  for (auto& [size, size_class] : classes_) {
    const double reach = size_class.max_radius + rows_[Index(wall.row)].reach + wall.sweep + slack_;
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
        const double tolerance = JoinTolerance(disk), distance = ClosestPoint(wall, centre, tolerance).distance;
        if (distance - disk.radius > ReachOf(disk.row, wall.row) + wall.sweep) return;
        const WallMeeting meeting = MeetingOf(disk, wall, centre, tolerance);
        if (meeting.closest.distance - disk.radius > ReachOf(disk.row, wall.row)) return;
        hits_.push_back({entry.disk, index, seen, meeting});
      });
    }
  }
}

/// Whether the corner, an end of `wall` as `other` sees it, lies on `other` too. Where bodies stand still: as an end of a
/// segment of the same body.
bool ContactDetector::IsJoined(const PlacedWall& wall, const PlacedWall& other, Vec2 corner, double tolerance) const {
  if (motion_ == nullptr) {
    const bool has_end = Norm(other.a - corner) <= tolerance || Norm(other.b - corner) <= tolerance;
    return other.row == wall.row && other.is_segment && has_end;
  }
  return ClosestPoint(other, corner, tolerance).distance <= tolerance;
}

/// Where hits of one disk meet in a corner, a flat side takes it, else the segment with the smallest number: the joints of a
/// line do not show. Of a side that rises from another one the corner is hidden, but not the side. The hits come in the order
/// in which the disk meets them. One that yields to a flat side stands for that side from then on: so pieces that are shorter
/// than the way hide the joints behind them.
void ContactDetector::Yield(WallHit* hit, std::span<const WallHit> of_disk) const {
  WallMeeting& own = hit->meeting;
  if (!own.closest.is_end) return;
  const PlacedDisk& disk = disks_[Index(hit->disk)];
  const PlacedWall& wall = walls_[Index(hit->wall)];
  const double tolerance = JoinTolerance(disk);
  for (const WallHit& other : of_disk) {
    const PlacedWall& segment = walls_[Index(other.wall)];
    const Vec2 shift{(hit->image - other.image) * period_, 0.0}, corner = own.closest.point + shift;
    // Beyond a wall that it has met before, the disk does not come.
    const bool is_before = other.meeting.moment < own.moment && other.meeting.closest.distance < disk.radius * (1.0 + 1e-6);
    const bool stands_for_another = other.is_taken && is_before && !other.meeting.closest.is_end;
    if (&other == hit || (other.is_taken && !stands_for_another) || !IsJoined(wall, segment, corner, tolerance)) continue;
    const WallPoint there =
        is_before ? other.meeting.closest : ClosestPoint(segment, other.meeting.SeenAt(own.moment, segment), tolerance);
    if (there.is_end) {
      hit->is_taken =
          Norm(there.point - corner) <= tolerance && std::tie(other.wall, other.image) < std::tie(hit->wall, hit->image);
    } else if (const Vec2 end = Norm(wall.a - own.closest.point) <= tolerance ? wall.b : wall.a;
               motion_ != nullptr && Dot(there.normal, end + shift - corner) > 1e-9 * Norm(end + shift - corner)) {
      own.closest = PointOfLine(wall, own.SeenAt(own.moment, wall), own.seen - wall.a);
      return;
    } else {
      hit->is_taken = true;
      own.closest = there;
      if (is_before) own.moment = other.meeting.moment;
    }
    if (hit->is_taken) return;
  }
}

void ContactDetector::AddSegmentPairs() {
  std::sort(hits_.begin(), hits_.end(), [](const WallHit& p, const WallHit& q) {
    return std::tie(p.disk, p.meeting.moment, p.wall, p.image) < std::tie(q.disk, q.meeting.moment, q.wall, q.image);
  });
  for (std::size_t begin = 0, end = 0; begin < hits_.size(); begin = end) {
    while (end < hits_.size() && hits_[end].disk == hits_[begin].disk) ++end;
    const std::span<WallHit> of_disk(hits_.data() + begin, end - begin);
    for (WallHit& hit : of_disk) {
      Yield(&hit, of_disk);
      if (!hit.is_taken) AddWallPair(hit.disk, hit.wall, hit.image, hit.meeting);
    }
  }
}

void ContactDetector::AddWallPair(std::int32_t disk, std::int32_t wall, std::int32_t image, const WallMeeting& meeting) {
  const auto index = static_cast<std::int32_t>(meetings_.size());
  meetings_.push_back(meeting);
  const PlacedDisk& d = disks_[Index(disk)];
  const PlacedWall& w = walls_[Index(wall)];
  if (d.row < w.row) {
    candidates_.push_back({d.row, w.row, d.shape, w.shape, image, disk, -1 - wall, index});
  } else {
    candidates_.push_back({w.row, d.row, w.shape, d.shape, -image, -1 - wall, disk, index});
  }
}

}  // namespace nscdd::reference
