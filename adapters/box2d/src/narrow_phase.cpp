// SPDX-License-Identifier: Apache-2.0
#include "narrow_phase.h"

#include <cmath>

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
                      std::span<const Candidate> candidates, double alert, ContactTable* contacts) {
  store_ = &store;
  placement_ = &placement;
  filter_ = &filter;
  contacts_ = contacts;
  alert_ = alert;
  has_arms_ = false;
  contacts->Clear();
  for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
    const Candidate& first = candidates[begin];
    const std::int32_t row_a = placement.shape(first.a).row, row_b = placement.shape(first.b).row;
    bool has_wall = false;
    for (; end < candidates.size() && placement.shape(candidates[end].a).row == row_a &&
           placement.shape(candidates[end].b).row == row_b;
         ++end) {
      has_wall = has_wall || store.shape(candidates[end].a).wall >= 0 || store.shape(candidates[end].b).wall >= 0;
    }
    if (has_wall) {
      TestRun(candidates.subspan(begin, end - begin));
    } else {
      for (std::size_t i = begin; i < end; ++i) TestDisks(candidates[i]);
    }
  }
}

std::int32_t NarrowPhase::Image(const Candidate& c) const {
  return c.shift + placement_->shape(c.a).wraps - placement_->shape(c.b).wraps;
}

Vec2 NarrowPhase::ArmOf(std::int32_t index) const {
  const Shape& shape = store_->shape(index);
  return IsZero(shape.centre) ? Vec2{} : Turn(placement_->body(shape.body), shape.centre);
}

void NarrowPhase::TestDisks(const Candidate& candidate) {
  const ShapePlace &a = placement_->shape(candidate.a), &b = placement_->shape(candidate.b);
  const Vec2 seen_b{b.centre.x + Image(candidate) * placement_->period, b.centre.y};
  const Vec2 d = seen_b - a.centre;
  const double radii = a.radius + b.radius, reach = radii + alert_, square = Dot(d, d);
  if (square > reach * reach * (1.0 + 1e-12)) return;
  const double distance = std::sqrt(square), gap = distance - radii;
  if (gap > alert_ || !filter_->Allows(store_->shape(candidate.a), store_->shape(candidate.b))) return;
  EmitHead(candidate, distance > 0.0 ? (1.0 / distance) * d : Vec2{0.0, 1.0}, gap);
  contacts_->lever_a.push_back(a.radius + 0.5 * gap);
  contacts_->lever_b.push_back(b.radius + 0.5 * gap);
  contacts_->site.push_back(0.5 * (a.centre + seen_b));
  contacts_->flat.push_back(0);
  EmitArms(ArmOf(candidate.a), ArmOf(candidate.b));
}

void NarrowPhase::TestRun(std::span<const Candidate> run) {
  const auto has_wall = [this](const Candidate& c) { return store_->shape(c.a).wall >= 0 || store_->shape(c.b).wall >= 0; };
  hits_.clear();
  for (const Candidate& candidate : run) {
    if (has_wall(candidate)) TestWall(candidate);
  }
  std::size_t hit = 0;
  for (const Candidate& candidate : run) {
    if (!has_wall(candidate)) TestDisks(candidate);
    if (hit == hits_.size() || hits_[hit].candidate != &candidate) continue;
    if (!IsTaken(hit)) EmitWall(hits_[hit]);
    ++hit;
  }
}

void NarrowPhase::TestWall(const Candidate& candidate) {
  const bool wall_is_a = store_->shape(candidate.a).wall >= 0;
  const Shape& wall = store_->shape(wall_is_a ? candidate.a : candidate.b);
  const ShapePlace& disk = placement_->shape(wall_is_a ? candidate.b : candidate.a);
  const BodyPlace& body = placement_->body(wall.body);
  const double shift = Image(candidate) * placement_->period;  // of B
  const Vec2 seen{disk.centre.x + (wall_is_a ? shift : -shift), disk.centre.y};
  WallPoint closest =
      ClosestPoint(wall.kind, store_->wall(wall.wall), TurnBack(body, seen - body.centre), JoinTolerance(disk.radius));
  if (closest.distance - disk.radius > alert_ || !filter_->Allows(store_->shape(candidate.a), store_->shape(candidate.b)))
    return;
  closest.point = Turn(body, closest.point);
  closest.normal = Turn(body, closest.normal);
  hits_.push_back({&candidate, closest, wall_is_a});
}

/// Segments of one body that share an end are one smooth line: a disk in front of the flat side of one of them meets no corner
/// there, and a disk in front of none meets the corner once, on the segment with the smallest number.
bool NarrowPhase::IsTaken(std::size_t hit) const {
  const Hit& own = hits_[hit];
  if (!own.closest.is_corner || hits_.size() == 1) return false;
  const auto disk_of = [](const Hit& h) { return h.wall_is_a ? h.candidate->b : h.candidate->a; };
  const auto shift_of = [this](const Hit& h) { return (h.wall_is_a ? -1 : 1) * Image(*h.candidate) * placement_->period; };
  const double radius = placement_->shape(disk_of(own)).radius;
  const double tolerance = JoinTolerance(radius) + 1e-6 * radius + 1e-7 * Norm(own.closest.point);
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const Hit& other = hits_[i];
    if (i == hit || disk_of(other) != disk_of(own)) continue;
    const Vec2 corner{own.closest.point.x + shift_of(own) - shift_of(other), own.closest.point.y};
    const bool is_same_corner = other.closest.is_corner && Norm(other.closest.point - corner) <= tolerance;
    if (HasEndAt(other, corner, tolerance) && (!other.closest.is_corner || (is_same_corner && i < hit))) return true;
  }
  return false;
}

bool NarrowPhase::HasEndAt(const Hit& hit, Vec2 corner, double tolerance) const {
  const Shape& shape = store_->shape(hit.wall_is_a ? hit.candidate->a : hit.candidate->b);
  if (shape.kind != ShapeKind::kSegment) return false;
  const Wall& wall = store_->wall(shape.wall);
  const BodyPlace& body = placement_->body(shape.body);
  return Norm(Turn(body, wall.points[0]) - corner) <= tolerance || Norm(Turn(body, wall.points[1]) - corner) <= tolerance;
}

void NarrowPhase::EmitWall(const Hit& hit) {
  const Candidate& candidate = *hit.candidate;
  const std::int32_t wall = hit.wall_is_a ? candidate.a : candidate.b, disk = hit.wall_is_a ? candidate.b : candidate.a;
  const WallPoint& closest = hit.closest;
  EmitHead(candidate, hit.wall_is_a ? closest.normal : -1.0 * closest.normal,
           closest.distance - placement_->shape(disk).radius);
  contacts_->lever_a.push_back(hit.wall_is_a ? 0.0 : closest.distance);
  contacts_->lever_b.push_back(hit.wall_is_a ? closest.distance : 0.0);
  // The point on the wall, or the centre of a disk that lies deeper behind it than its radius.
  const bool is_deep = closest.distance < -placement_->shape(disk).radius;
  Vec2 site = is_deep ? placement_->shape(disk).centre : placement_->shape(wall).centre + closest.point;
  if (is_deep == hit.wall_is_a) site.x += Image(candidate) * placement_->period;
  contacts_->site.push_back(site);
  contacts_->flat.push_back(closest.is_corner ? 0 : 1);
  hit.wall_is_a ? EmitArms(closest.point, ArmOf(disk)) : EmitArms(ArmOf(disk), closest.point);
}

void NarrowPhase::EmitHead(const Candidate& c, Vec2 normal, double gap) {
  const Shape &a = store_->shape(c.a), &b = store_->shape(c.b);
  contacts_->a.push_back(placement_->shape(c.a).row);
  contacts_->b.push_back(placement_->shape(c.b).row);
  contacts_->shape_a.push_back(c.a - store_->record(a.body).first_shape);
  contacts_->shape_b.push_back(c.b - store_->record(b.body).first_shape);
  if (placement_->period > 0.0) contacts_->image.push_back(Image(c));
  contacts_->gap.push_back(gap);
  contacts_->normal.push_back(normal);
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
