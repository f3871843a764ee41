// SPDX-License-Identifier: Apache-2.0
#include "narrow_phase.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nscdd::box2d {
namespace {

Vec2 Turn(const BodyPlace& body, Vec2 a) { return {body.cosine * a.x - body.sine * a.y, body.sine * a.x + body.cosine * a.y}; }
Vec2 TurnBack(const BodyPlace& body, Vec2 a) {
  return {body.cosine * a.x + body.sine * a.y, -body.sine * a.x + body.cosine * a.y};
}

double Mix(double a, double b) { return std::sqrt(a * b); }

bool IsZero(Vec2 a) { return a.x == 0.0 && a.y == 0.0; }

}  // namespace

void NarrowPhase::Run(const BodyStore& store, const Placement& placement, const PairFilter& filter,
                      std::span<const Candidate> candidates, ContactTable* contacts) {
  store_ = &store;
  placement_ = &placement;
  filter_ = &filter;
  contacts_ = contacts;
  has_arms_ = false;
  contacts->Clear();
  hits_.clear();
  const auto has_wall = [&](const Candidate& c) { return store.shape(c.a).wall >= 0 || store.shape(c.b).wall >= 0; };
  for (const Candidate& candidate : candidates) {
    if (has_wall(candidate)) TestWall(candidate);
  }
  YieldAtJoints();
  auto hit = hits_.begin();
  for (const Candidate& candidate : candidates) {
    if (!has_wall(candidate)) TestDisks(candidate);
    if (hit == hits_.end() || hit->candidate != &candidate) continue;
    if (!hit->is_taken) EmitWall(*hit);
    ++hit;
  }
}

double NarrowPhase::ReachOf(const Candidate& c) const {
  return placement_->body(store_->shape(c.a).body).reach + placement_->body(store_->shape(c.b).body).reach;
}

std::int32_t NarrowPhase::Image(const Candidate& c) const {
  return c.shift + placement_->shape(c.a).wraps - placement_->shape(c.b).wraps;
}

Vec2 NarrowPhase::ArmOf(std::int32_t index) const {
  const Shape& shape = store_->shape(index);
  return IsZero(shape.centre) ? Vec2{} : Turn(placement_->body(shape.body), shape.centre);
}

Vec2 NarrowPhase::ArmAt(std::int32_t index, double moment) const {
  const Vec2 arm = ArmOf(index);
  const double turn = moment * placement_->body(store_->shape(index).body).turn;
  return moment == 0.0 || turn == 0.0 || IsZero(arm) ? arm : Rotate(turn, arm);
}

/// The moment at which two disks meet whose centres part by `between` at the beginning.
double NarrowPhase::MeetingOf(const Candidate& c, Vec2 between) const {
  if (!placement_->is_swept) return 0.0;
  const BodyPlace &a = placement_->body(store_->shape(c.a).body), &b = placement_->body(store_->shape(c.b).body);
  const Vec2 move = b.move - a.move, arm_a = ArmOf(c.a), arm_b = ArmOf(c.b);
  const double radii = placement_->shape(c.a).radius + placement_->shape(c.b).radius;
  const bool is_straight = (a.turn == 0.0 || IsZero(arm_a)) && (b.turn == 0.0 || IsZero(arm_b));
  if (is_straight) return DiskMeeting(between, move, radii);
  const auto of_point = [](Vec2 x) {
    const double distance = Norm(x);
    return WallPoint{{}, distance > 0.0 ? (1.0 / distance) * x : Vec2{0.0, 1.0}, distance, true};
  };
  return ShapeMeeting({between - arm_b + arm_a, move, arm_a, arm_b, a.turn, b.turn, 0.0, radii}, of_point);
}

void NarrowPhase::TestDisks(const Candidate& candidate) {
  const ShapePlace &a = placement_->shape(candidate.a), &b = placement_->shape(candidate.b);
  const Vec2 seen_b{b.centre.x + Image(candidate) * placement_->period, b.centre.y};
  Vec2 d = seen_b - a.centre;
  const double radii = a.radius + b.radius, alert = ReachOf(candidate), reach = radii + alert, square = Dot(d, d);
  if (square > reach * reach * (1.0 + 1e-12)) return;
  if (std::sqrt(square) - radii > alert || !filter_->Allows(store_->shape(candidate.a), store_->shape(candidate.b))) return;
  const double moment = MeetingOf(candidate, d);
  const Vec2 arm_a = ArmAt(candidate.a, moment), arm_b = ArmAt(candidate.b, moment);
  if (moment > 0.0) {
    const Vec2 move =
        placement_->body(store_->shape(candidate.b).body).move - placement_->body(store_->shape(candidate.a).body).move;
    d = d + moment * move + (arm_b - ArmOf(candidate.b)) - (arm_a - ArmOf(candidate.a));
  }
  const double distance = std::sqrt(Dot(d, d)), gap = distance - radii;
  EmitHead(candidate, distance > 0.0 ? (1.0 / distance) * d : Vec2{0.0, 1.0}, gap, moment);
  contacts_->lever_a.push_back(a.radius + 0.5 * gap);
  contacts_->lever_b.push_back(b.radius + 0.5 * gap);
  contacts_->site.push_back(0.5 * (a.centre + seen_b));
  contacts_->flat.push_back(0);
  EmitArms(arm_a, arm_b);
}

/// The point of the wall that is closest to the disk at `seen`.
WallPoint NarrowPhase::ClosestAt(const Hit& hit, Vec2 seen) const {
  const Shape& wall = store_->shape(hit.wall);
  const BodyPlace& body = placement_->body(wall.body);
  WallPoint closest =
      ClosestPoint(wall.kind, store_->wall(wall.wall), TurnBack(body, seen), JoinTolerance(placement_->shape(hit.disk).radius));
  closest.point = Turn(body, closest.point);
  closest.normal = Turn(body, closest.normal);
  return closest;
}

void NarrowPhase::TestWall(const Candidate& candidate) {
  Hit hit;
  hit.candidate = &candidate;
  hit.wall_is_a = store_->shape(candidate.a).wall >= 0;
  hit.disk = hit.wall_is_a ? candidate.b : candidate.a;
  hit.wall = hit.wall_is_a ? candidate.a : candidate.b;
  const Shape& wall = store_->shape(hit.wall);
  const ShapePlace& disk = placement_->shape(hit.disk);
  const BodyPlace& body = placement_->body(wall.body);
  hit.seen = Vec2{disk.centre.x - ShiftOf(hit), disk.centre.y} - body.centre;
  hit.closest = ClosestAt(hit, hit.seen);
  const double reach = disk.radius + ReachOf(candidate);
  // What turns with a half-plane comes further than its body's reach, which knows no half-planes.
  const bool sweeps_on = placement_->is_swept && body.turn != 0.0 && std::isinf(store_->record(wall.body).bounding_radius);
  if ((hit.closest.distance > reach && !sweeps_on) || !filter_->Allows(store_->shape(candidate.a), store_->shape(candidate.b)))
    return;
  if (placement_->is_swept) Meet(&hit);
  if (hit.closest.distance <= reach) hits_.push_back(hit);
}

void NarrowPhase::Meet(Hit* hit) const {
  const BodyPlace &body = placement_->body(store_->shape(hit->disk).body),
                  &wall = placement_->body(store_->shape(hit->wall).body);
  const Vec2 arm = ArmOf(hit->disk);
  hit->way = {hit->seen - arm, body.move - wall.move, {}, arm, 0.0, body.turn, wall.turn, placement_->shape(hit->disk).radius};
  hit->moment = ShapeMeeting(hit->way, [&](Vec2 x) { return ClosestAt(*hit, x); });
  if (hit->moment > 0.0) hit->closest = ClosestAt(*hit, SeenAt(*hit, hit->moment));
}

/// How far the disk is moved in x where the wall sees it.
double NarrowPhase::ShiftOf(const Hit& hit) const {
  return (hit.wall_is_a ? -1 : 1) * Image(*hit.candidate) * placement_->period;
}

void NarrowPhase::YieldAtJoints() {
  by_disk_.clear();
  for (Hit& hit : hits_) by_disk_.push_back(&hit);
  std::stable_sort(by_disk_.begin(), by_disk_.end(),
                   [](const Hit* p, const Hit* q) { return std::tie(p->disk, p->moment) < std::tie(q->disk, q->moment); });
  for (std::size_t begin = 0, end = 0; begin < by_disk_.size(); begin = end) {
    while (end < by_disk_.size() && by_disk_[end]->disk == by_disk_[begin]->disk) ++end;
    const std::span<Hit* const> of_disk(by_disk_.data() + begin, end - begin);
    for (Hit* hit : of_disk) Yield(hit, of_disk);
  }
}

/// Whether the corner, a point of the wall of `hit` as that of `other` sees it, belongs to it too. Where bodies stand still: as
/// the end of a segment of the same body.
bool NarrowPhase::IsJoined(const Hit& hit, const Hit& other, Vec2 corner, double tolerance) const {
  if (!placement_->is_swept) {
    return store_->shape(other.wall).body == store_->shape(hit.wall).body && HasEndAt(other, corner, tolerance);
  }
  return std::abs(ClosestAt(other, corner).distance) <= tolerance;
}

/// Whether the segment of the hit rises, from its corner, over a side with this normal.
bool NarrowPhase::RisesFrom(const Hit& hit, Vec2 normal) const {
  const Shape& shape = store_->shape(hit.wall);
  for (const Vec2 point : store_->wall(shape.wall).points) {
    const Vec2 along = Turn(placement_->body(shape.body), point) - hit.closest.point;
    if (Dot(normal, along) > 1e-6 * Norm(along)) return true;
  }
  return false;
}

/// Shapes that share a corner are one smooth line: a disk in front of the flat side of one of them meets no corner there, and a
/// disk in front of none meets the corner once, on the first of them. Of a side that rises from another one the corner is
/// hidden, but not the side. The hits come in the order in which the disk meets them. One that yields to a flat side stands for
/// that side from then on: so pieces that are shorter than the way hide the joints behind them.
void NarrowPhase::Yield(Hit* hit, std::span<Hit* const> of_disk) const {
  if (!hit->closest.is_corner || of_disk.size() == 1) return;
  const double radius = placement_->shape(hit->disk).radius;
  const double tolerance = JoinTolerance(radius) + 1e-6 * radius + 1e-7 * Norm(hit->closest.point);
  for (const Hit* other : of_disk) {
    // Beyond a wall that it has met before, the disk does not come.
    const bool is_met = other->moment < hit->moment && other->closest.distance < radius * (1.0 + 1e-6);
    const bool stands_for_another = other->is_taken && is_met && !other->closest.is_corner;
    if (other == hit || (other->is_taken && !stands_for_another)) continue;
    const Vec2 from = placement_->body(store_->shape(hit->wall).body).centre,
               to = placement_->body(store_->shape(other->wall).body).centre;
    const Vec2 corner = hit->closest.point + (from - to) + Vec2{ShiftOf(*hit) - ShiftOf(*other), 0.0};
    if (!IsJoined(*hit, *other, corner, tolerance)) continue;
    const WallPoint there =
        is_met || hit->moment == other->moment ? other->closest : ClosestAt(*other, SeenAt(*other, hit->moment));
    if (there.is_corner) {
      if (Norm(there.point - corner) > tolerance || other > hit) continue;
      hit->is_taken = true;
    } else if (placement_->is_swept && RisesFrom(*hit, there.normal)) {
      const Shape& shape = store_->shape(hit->wall);
      if (shape.kind != ShapeKind::kSegment) continue;
      const BodyPlace& body = placement_->body(shape.body);
      const Wall& wall = store_->wall(shape.wall);
      hit->closest = PointOfLine(wall, TurnBack(body, SeenAt(*hit, hit->moment)), TurnBack(body, hit->seen) - wall.points[0]);
      hit->closest.point = Turn(body, hit->closest.point);
      hit->closest.normal = Turn(body, hit->closest.normal);
    } else {
      hit->is_taken = true;
      hit->closest = there;
      if (is_met) hit->moment = other->moment;
    }
    return;
  }
}

bool NarrowPhase::HasEndAt(const Hit& hit, Vec2 corner, double tolerance) const {
  const Shape& shape = store_->shape(hit.wall);
  if (shape.kind != ShapeKind::kSegment) return false;
  const Wall& wall = store_->wall(shape.wall);
  const BodyPlace& body = placement_->body(shape.body);
  return Norm(Turn(body, wall.points[0]) - corner) <= tolerance || Norm(Turn(body, wall.points[1]) - corner) <= tolerance;
}

void NarrowPhase::EmitWall(const Hit& hit) {
  const Candidate& candidate = *hit.candidate;
  const ShapePlace& disk = placement_->shape(hit.disk);
  const double turn = hit.moment * placement_->body(store_->shape(hit.wall).body).turn;  // the wall's until then
  const bool turns = hit.moment > 0.0 && turn != 0.0;
  const Vec2 normal = turns ? Rotate(turn, hit.closest.normal) : hit.closest.normal;
  const Vec2 on_wall = turns ? Rotate(turn, hit.closest.point) : hit.closest.point;
  EmitHead(candidate, hit.wall_is_a ? normal : -1.0 * normal, hit.closest.distance - disk.radius, hit.moment);
  contacts_->lever_a.push_back(hit.wall_is_a ? 0.0 : hit.closest.distance);
  contacts_->lever_b.push_back(hit.wall_is_a ? hit.closest.distance : 0.0);
  // At the beginning: the point on the wall, or the centre of a disk that lies deeper behind it than its radius.
  const WallPoint begin = hit.moment == 0.0 ? hit.closest : ClosestAt(hit, hit.seen);
  const bool is_deep = begin.distance < -disk.radius || begin.distance > disk.radius + ReachOf(candidate);
  Vec2 site = is_deep ? disk.centre : placement_->shape(hit.wall).centre + begin.point;
  if (is_deep == hit.wall_is_a) site.x += Image(candidate) * placement_->period;
  contacts_->site.push_back(site);
  contacts_->flat.push_back(hit.closest.is_corner ? 0 : 1);
  const Vec2 arm = ArmAt(hit.disk, hit.moment);
  hit.wall_is_a ? EmitArms(on_wall, arm) : EmitArms(arm, on_wall);
}

void NarrowPhase::EmitHead(const Candidate& c, Vec2 normal, double gap, double moment) {
  const Shape &a = store_->shape(c.a), &b = store_->shape(c.b);
  contacts_->a.push_back(placement_->shape(c.a).row);
  contacts_->b.push_back(placement_->shape(c.b).row);
  contacts_->shape_a.push_back(c.a - store_->record(a.body).first_shape);
  contacts_->shape_b.push_back(c.b - store_->record(b.body).first_shape);
  if (placement_->period > 0.0) contacts_->image.push_back(Image(c));
  contacts_->gap.push_back(gap);
  contacts_->normal.push_back(normal);
  if (placement_->is_swept) contacts_->moment.push_back(moment);
  contacts_->friction.push_back(Mix(a.friction, b.friction));
  contacts_->restitution.push_back(std::max(a.restitution, b.restitution));
}

/// Called last for each contact. Nothing is stored before the first arm that is not zero.
void NarrowPhase::EmitArms(Vec2 arm_a, Vec2 arm_b) {
  if (!has_arms_ && IsZero(arm_a) && IsZero(arm_b)) return;
  if (!has_arms_) {
    contacts_->arm_a.resize(contacts_->size() - 1);
    contacts_->arm_b.resize(contacts_->size() - 1);
    has_arms_ = true;
  }
  contacts_->arm_a.push_back(arm_a);
  contacts_->arm_b.push_back(arm_b);
}

}  // namespace nscdd::box2d
