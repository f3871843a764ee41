// SPDX-License-Identifier: Apache-2.0
// The second half of ContactDetector: the numbers of each contact, from A to B, whatever way the pair was found.
#include <cmath>

#include "contact_detector.h"

namespace nscdd::reference {
namespace {

std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

bool IsZero(Vec2 a) { return a.x == 0.0 && a.y == 0.0; }

void Resize(std::size_t count, bool periodic, ContactTable* contacts) {
  contacts->a.resize(count);
  contacts->b.resize(count);
  contacts->shape_a.resize(count);
  contacts->shape_b.resize(count);
  contacts->image.resize(periodic ? count : 0);
  contacts->gap.resize(count);
  contacts->normal.resize(count);
  contacts->lever_a.resize(count);
  contacts->lever_b.resize(count);
  contacts->arm_a.resize(count);
  contacts->arm_b.resize(count);
  contacts->site.resize(count);
  contacts->flat.resize(count);
  contacts->friction.resize(count);
  contacts->restitution.resize(count);
}

}  // namespace

void ContactDetector::FillTable(ContactTable* contacts) const {
  Resize(candidates_.size(), period_ > 0.0, contacts);
  bool has_arms = false;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& candidate = candidates_[i];
    const Row &a = rows_[Index(candidate.a)], &b = rows_[Index(candidate.b)];
    contacts->a[i] = candidate.a;
    contacts->b[i] = candidate.b;
    contacts->shape_a[i] = candidate.shape_a;
    contacts->shape_b[i] = candidate.shape_b;
    if (period_ > 0.0) contacts->image[i] = candidate.image;
    contacts->friction[i] = std::sqrt(a.friction * b.friction);
    contacts->restitution[i] = std::max(a.restitution, b.restitution);
    candidate.index_a >= 0 && candidate.index_b >= 0 ? FillDiskPair(candidate, i, contacts)
                                                     : FillWallPair(candidate, i, contacts);
    has_arms = has_arms || !IsZero(contacts->arm_a[i]) || !IsZero(contacts->arm_b[i]);
  }
  if (!has_arms) {
    contacts->arm_a.clear();
    contacts->arm_b.clear();
  }
}

void ContactDetector::FillDiskPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const {
  const PlacedDisk &a = disks_[Index(candidate.index_a)], &b = disks_[Index(candidate.index_b)];
  const Vec2 seen_b{b.centre.x + candidate.image * period_, b.centre.y};
  const Vec2 d = seen_b - a.centre;
  const double distance = std::sqrt(Dot(d, d));
  const double gap = distance - (a.radius + b.radius);
  contacts->gap[i] = gap;
  contacts->normal[i] = distance > 0.0 ? (1.0 / distance) * d : Vec2{0.0, 1.0};
  contacts->lever_a[i] = a.radius + 0.5 * gap;
  contacts->lever_b[i] = b.radius + 0.5 * gap;
  contacts->arm_a[i] = a.arm;
  contacts->arm_b[i] = b.arm;
  contacts->site[i] = 0.5 * (a.centre + seen_b);
  contacts->flat[i] = 0;
}

void ContactDetector::FillWallPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const {
  const bool wall_is_a = candidate.index_a < 0;
  const PlacedWall& wall = walls_[Index(-1 - (wall_is_a ? candidate.index_a : candidate.index_b))];
  const PlacedDisk& disk = disks_[Index(wall_is_a ? candidate.index_b : candidate.index_a)];
  const Vec2 shift{candidate.image * period_, 0.0};                              // of B
  const Vec2 seen_disk = wall_is_a ? disk.centre + shift : disk.centre - shift;  // from the wall where it is
  Vec2 normal = wall.normal, point;
  double distance = 0.0;
  std::uint8_t flat = 1;
  if (wall.is_segment) {
    const SegmentPoint closest = ClosestPoint(wall, seen_disk, JoinTolerance(disk));
    normal = closest.normal;
    distance = closest.distance;
    point = closest.point;
    flat = closest.is_end ? 0 : 1;
  } else {
    distance = Dot(normal, seen_disk - wall.centre) - wall.offset;
    point = seen_disk - distance * normal;
  }
  contacts->gap[i] = distance - disk.radius;
  contacts->normal[i] = wall_is_a ? normal : -1.0 * normal;
  contacts->lever_a[i] = wall_is_a ? 0.0 : distance;
  contacts->lever_b[i] = wall_is_a ? distance : 0.0;
  contacts->arm_a[i] = wall_is_a ? point - wall.centre : disk.arm;
  contacts->arm_b[i] = wall_is_a ? disk.arm : point - wall.centre;
  const Vec2 on_wall = wall_is_a ? point : point + shift;
  const Vec2 centre = wall_is_a ? seen_disk : disk.centre;
  contacts->site[i] = distance < -disk.radius ? centre : on_wall;
  contacts->flat[i] = flat;
}

}  // namespace nscdd::reference
