// SPDX-License-Identifier: Apache-2.0
// The second half of ContactDetector: the numbers of each contact, from A to B, whatever way the pair was found.
#include <cmath>

#include "contact_detector.h"

namespace nscdd::reference {
namespace {

std::size_t Index(std::int32_t i) { return static_cast<std::size_t>(i); }

bool IsZero(Vec2 a) { return a.x == 0.0 && a.y == 0.0; }

Vec2 ArmAt(double turn, Vec2 arm) { return turn == 0.0 || IsZero(arm) ? arm : Rotate(turn, arm); }

WallPoint OfPoint(Vec2 x) {
  const double distance = Norm(x);
  return {{}, distance > 0.0 ? (1.0 / distance) * x : Vec2{0.0, 1.0}, distance, true};
}

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
  contacts->moment.resize(count);
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
  if (motion_ == nullptr) contacts->moment.clear();
}

double ContactDetector::MeetingOf(const PlacedDisk& a, const PlacedDisk& b, Vec2 between) const {
  if (motion_ == nullptr) return 0.0;
  const Row &of_a = rows_[Index(a.row)], &of_b = rows_[Index(b.row)];
  const Vec2 move = of_b.move - of_a.move;
  const bool is_straight = (of_a.turn == 0.0 || IsZero(a.arm)) && (of_b.turn == 0.0 || IsZero(b.arm));
  if (is_straight) return DiskMeeting(between, move, a.radius + b.radius);
  return ShapeMeeting({between - b.arm + a.arm, move, a.arm, b.arm, of_a.turn, of_b.turn, 0.0, a.radius + b.radius}, OfPoint);
}

void ContactDetector::FillDiskPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const {
  const PlacedDisk &a = disks_[Index(candidate.index_a)], &b = disks_[Index(candidate.index_b)];
  const Vec2 seen_b{b.centre.x + candidate.image * period_, b.centre.y};
  Vec2 d = seen_b - a.centre;
  const double moment = MeetingOf(a, b, d);
  contacts->moment[i] = moment;
  contacts->arm_a[i] = a.arm;
  contacts->arm_b[i] = b.arm;
  if (moment > 0.0) {
    const Row &of_a = rows_[Index(a.row)], &of_b = rows_[Index(b.row)];
    contacts->arm_a[i] = ArmAt(moment * of_a.turn, a.arm);
    contacts->arm_b[i] = ArmAt(moment * of_b.turn, b.arm);
    d = d + moment * (of_b.move - of_a.move) + (contacts->arm_b[i] - b.arm) - (contacts->arm_a[i] - a.arm);
  }
  const double distance = std::sqrt(Dot(d, d));
  const double gap = distance - (a.radius + b.radius);
  contacts->gap[i] = gap;
  contacts->normal[i] = distance > 0.0 ? (1.0 / distance) * d : Vec2{0.0, 1.0};
  contacts->lever_a[i] = a.radius + 0.5 * gap;
  contacts->lever_b[i] = b.radius + 0.5 * gap;
  contacts->site[i] = 0.5 * (a.centre + seen_b);
  contacts->flat[i] = 0;
}

void ContactDetector::FillWallPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const {
  const bool wall_is_a = candidate.index_a < 0;
  const PlacedWall& wall = walls_[Index(-1 - (wall_is_a ? candidate.index_a : candidate.index_b))];
  const PlacedDisk& disk = disks_[Index(wall_is_a ? candidate.index_b : candidate.index_a)];
  const WallMeeting& meeting = meetings_[Index(candidate.meeting)];
  const double turn = meeting.moment * rows_[Index(wall.row)].turn;  // the wall's until then
  const WallPoint& closest = meeting.closest;
  const Vec2 normal = ArmAt(turn, closest.normal), on_wall = ArmAt(turn, closest.point - wall.centre);
  const Vec2 arm = ArmAt(meeting.moment * rows_[Index(disk.row)].turn, disk.arm);
  contacts->moment[i] = meeting.moment;
  contacts->gap[i] = closest.distance - disk.radius;
  contacts->normal[i] = wall_is_a ? normal : -1.0 * normal;
  contacts->lever_a[i] = wall_is_a ? 0.0 : closest.distance;
  contacts->lever_b[i] = wall_is_a ? closest.distance : 0.0;
  contacts->arm_a[i] = wall_is_a ? on_wall : arm;
  contacts->arm_b[i] = wall_is_a ? arm : on_wall;
  contacts->flat[i] = closest.is_end ? 0 : 1;
  // The site is that of the beginning.
  const WallPoint begin = meeting.moment == 0.0 ? closest : ClosestPoint(wall, meeting.seen, JoinTolerance(disk));
  const Vec2 shift{candidate.image * period_, 0.0};  // of B
  const Vec2 centre = wall_is_a ? meeting.seen : disk.centre;
  const bool is_far = begin.distance > disk.radius + ReachOf(disk.row, wall.row);  // of what turns
  contacts->site[i] = begin.distance < -disk.radius || is_far ? centre : wall_is_a ? begin.point : begin.point + shift;
}

}  // namespace nscdd::reference
