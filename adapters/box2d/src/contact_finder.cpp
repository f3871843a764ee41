// SPDX-License-Identifier: Apache-2.0
#include "contact_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "nscdd/error.h"

namespace nscdd::box2d {
namespace {

Vec2 Turn(const BodyPlace& body, Vec2 a) { return {body.cosine * a.x - body.sine * a.y, body.sine * a.x + body.cosine * a.y}; }

}  // namespace

void ContactFinder::Detect(const PoseView& poses, double alert, const PairFilter& filter, ContactTable* contacts) {
  if (!(alert >= 0.0 && std::isfinite(alert))) {
    throw Error(fmt::format("DetectContacts got the alert distance {}: give a finite length >= 0 in metres.", alert));
  }
  CheckPoses(poses);
  PlaceBodies(poses);
  placement_.is_swept = false;
  alert_ = alert;
  for (BodyPlace& body : placement_.bodies) body.reach = 0.5 * alert;
  Find(filter, contacts);
}

void ContactFinder::Sweep(const MotionView& motion, const PairFilter& filter, ContactTable* contacts) {
  CheckPoses({motion.id, motion.pose});
  PlaceBodies({motion.id, motion.pose});
  PlaceMotion(motion);
  Find(filter, contacts);
}

void ContactFinder::PlaceMotion(const MotionView& motion) {
  if (motion.velocity.size() != motion.id.size() || motion.reach.size() != motion.id.size()) {
    throw Error(fmt::format("SweepContacts got {} ids, {} velocities and {} reaches: give one of each for each body.",
                            motion.id.size(), motion.velocity.size(), motion.reach.size()));
  }
  placement_.is_swept = true;
  alert_ = std::numeric_limits<double>::infinity();
  const auto& rows = store_->Rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Twist& v = motion.velocity[i];
    BodyPlace& body = placement_.bodies[static_cast<std::size_t>(rows[i].slot)];
    body.reach = motion.reach[i];
    body.move = motion.dt * Linear(v);
    body.turn = motion.dt * v.spin;
    alert_ = std::min(alert_, 2.0 * body.reach);
    if (body.reach >= 0.0 && std::isfinite(body.move.x + body.move.y + body.turn + body.reach)) continue;
    throw Error(fmt::format("SweepContacts got body {} at ({}, {}, {}) for {} s and a reach of {} m: numbers must be finite.",
                            motion.id[i], v.vx, v.vy, v.spin, motion.dt, motion.reach[i]));
  }
  if (rows.empty()) alert_ = 0.0;
}

void ContactFinder::Find(const PairFilter& filter, ContactTable* contacts) {
  if (period_ > 0.0) CheckPeriod();
  UpdateBoxes();
  if (broad_phase_.is_any_touched()) {
    UpdateCandidates();
    SortCandidates();
    broad_phase_.FinishUpdate();
  }
  narrow_phase_.Run(*store_, placement_, filter, candidates_, contacts);
}

void ContactFinder::CheckPoses(const PoseView& poses) const {
  const auto& rows = store_->Rows();
  if (poses.id.size() != rows.size() || poses.pose.size() != rows.size()) {
    throw Error(
        fmt::format("DetectContacts got {} ids and {} poses, and the b2World has {} enabled bodies: give each of them once.",
                    poses.id.size(), poses.pose.size(), rows.size()));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Pose& q = poses.pose[i];
    if (poses.id[i] != rows[i].id) {
      throw Error(
          fmt::format("DetectContacts got body {} where the b2World has body {}: name every enabled body once, in ascending "
                      "order of id.",
                      poses.id[i], rows[i].id));
    }
    if (!std::isfinite(q.x + q.y + q.angle)) {
      throw Error(
          fmt::format("DetectContacts got body {} at ({}, {}, {}): poses must be finite.", poses.id[i], q.x, q.y, q.angle));
    }
  }
}

void ContactFinder::CheckPeriod() const {
  for (const auto& [id, slot] : store_->Rows()) {
    const BodyRecord& r = store_->record(slot);
    if (r.kind == BodyKind::kFree) {
      const double alert = 2.0 * placement_.body(slot).reach;
      if (2.0 * r.bounding_radius + alert < period_) continue;
      throw Error(
          fmt::format("Box2D body {} is {} m wide and would touch its own image: the period, {} m, must be longer than that "
                      "and the alert distance of {} m together.",
                      id, 2.0 * r.bounding_radius, period_, alert));
    }
    for (std::int32_t i = r.first_shape; i < r.first_shape + r.shape_count; ++i) {
      const Shape& shape = store_->shape(i);
      if (shape.wall < 0 || shape.kind == ShapeKind::kNone) continue;
      const Wall& wall = store_->wall(shape.wall);
      const BodyPlace& body = placement_.body(slot);
      if (shape.kind == ShapeKind::kHalfPlane && std::abs(Turn(body, wall.normals[0]).x) > 1e-12) {
        throw Error(fmt::format("Half-plane {} of Box2D body {} is not horizontal, yet the world is periodic in x: turn it.",
                                i - r.first_shape, id));
      }
      double begin = std::numeric_limits<double>::infinity(), end = -begin;
      for (const Vec2 point : wall.points) {
        begin = std::min(begin, Turn(body, point).x);
        end = std::max(end, Turn(body, point).x);
      }
      if (end - begin > period_ * (1.0 + 1e-6)) {
        throw Error(fmt::format("Shape {} of Box2D body {} is {} m long in x, more than the period {} m: cut it to one period.",
                                i - r.first_shape, id, end - begin, period_));
      }
    }
  }
}

void ContactFinder::PlaceBodies(const PoseView& poses) {
  placement_.period = period_;
  placement_.bodies.resize(store_->slot_count());
  placement_.shapes.resize(store_->shape_count());
  const auto& rows = store_->Rows();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double lower_x = kInfinity, lower_y = kInfinity, upper_x = -kInfinity, upper_y = -kInfinity, farthest = period_;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Pose& q = poses.pose[i];
    const BodyRecord& r = store_->record(rows[i].slot);
    BodyPlace& body = placement_.bodies[static_cast<std::size_t>(rows[i].slot)];
    body.centre = Centre(q);
    body.row = static_cast<std::int32_t>(i);
    if (!r.is_round) {
      body.cosine = std::cos(q.angle);
      body.sine = std::sin(q.angle);
    }
    PlaceShapes(rows[i].slot);
    farthest = std::max({farthest, std::abs(q.x), std::abs(q.y)});
    if (r.kind != BodyKind::kFree) continue;
    lower_x = std::min(lower_x, q.x);
    lower_y = std::min(lower_y, q.y);
    upper_x = std::max(upper_x, q.x);
    upper_y = std::max(upper_y, q.y);
  }
  placement_.slack = 1e-14 * (farthest + std::abs(period_origin_));
  if (period_ > 0.0 && placement_.slack > 1e-3 * period_) {
    throw Error(
        fmt::format("A Box2D body is {} m away from 0, where rounding swallows the period of {} m: bring it back or remove it.",
                    farthest, period_));
  }
  const bool is_any_free = lower_x <= upper_x;
  middle_ = is_any_free ? Vec2{0.5 * (lower_x + upper_x), 0.5 * (lower_y + upper_y)} : Vec2{};
  half_extent_ = is_any_free ? 0.5 * std::max(upper_x - lower_x, upper_y - lower_y) : 0.0;
}

void ContactFinder::PlaceShapes(std::int32_t slot) {
  const BodyRecord& r = store_->record(slot);
  const BodyPlace& body = placement_.body(slot);
  for (std::int32_t i = r.first_shape; i < r.first_shape + r.shape_count; ++i) {
    const Shape& shape = store_->shape(i);
    ShapePlace& place = placement_.shapes[static_cast<std::size_t>(i)];
    place.centre = shape.kind == ShapeKind::kDisk ? body.centre + Turn(body, shape.centre) : body.centre;
    place.radius = shape.radius;
    place.row = body.row;
    place.wraps = 0;
    if (period_ == 0.0 || r.kind != BodyKind::kFree) continue;
    const double wraps = std::floor((place.centre.x - period_origin_) / period_);
    if (std::abs(wraps) > 1e8) {
      throw Error(fmt::format("Box2D body {} is {} periods away from the domain: bring it back into the period.", r.id, wraps));
    }
    place.wraps = static_cast<std::int32_t>(wraps);
  }
}

/// Starts the trees anew when their unit or origin no longer fits, or their boxes are far too fat: costs time, no result.
bool ContactFinder::NeedsRestart(double alert) const {
  if (!broad_phase_.has_started()) return true;
  const double unit = broad_phase_.unit(), radius = store_->mean_radius();
  if (radius > 0.0 && !(radius < 2.0 * unit && radius > 0.5 * unit)) return true;
  if (alert_of_start_ > 0.2 * unit && alert < 0.25 * alert_of_start_) return true;
  const double off = Norm(middle_ - broad_phase_.origin());
  return off + half_extent_ > 1e5 * unit && off > half_extent_;
}

void ContactFinder::UpdateBoxes() {
  if (NeedsRestart(alert_)) {
    const double radius = store_->mean_radius();
    broad_phase_.Restart(middle_, radius > 0.0 ? radius : 1.0, period_, period_origin_);
    candidates_.clear();
    alert_of_start_ = 0.0;
  }
  alert_of_start_ = std::max(alert_of_start_, alert_);
  broad_phase_.Resize(store_->shape_count());
  for (const std::int32_t shape : store_->changed_shapes()) broad_phase_.Remove(shape);
  store_->ClearChanges();
  for (const auto& [id, slot] : store_->Rows()) {
    const BodyRecord& r = store_->record(slot);
    const double margin = placement_.body(slot).reach + 2.0 * placement_.slack;
    for (std::int32_t i = r.first_shape; i < r.first_shape + r.shape_count; ++i) {
      if (store_->shape(i).kind != ShapeKind::kNone) broad_phase_.Update(i, r.kind == BodyKind::kFree, BoxOf(i, margin));
    }
  }
}

Box ContactFinder::BoxOf(std::int32_t index, double margin) const {
  const Shape& shape = store_->shape(index);
  const ShapePlace& place = placement_.shape(index);
  if (shape.kind == ShapeKind::kDisk) {
    const double reach = shape.radius + margin, x = place.centre.x - place.wraps * period_;
    return {x - reach, place.centre.y - reach, x + reach, place.centre.y + reach};
  }
  const BodyPlace& body = placement_.body(shape.body);
  const Wall& wall = store_->wall(shape.wall);
  if (shape.kind == ShapeKind::kHalfPlane) {
    const double far = BroadPhase::kFar * broad_phase_.unit();
    const Vec2 normal = Turn(body, wall.normals[0]);
    Box box{-far, -far, far, far};
    if (placement_.is_swept && body.turn != 0.0) return box;  // it sweeps further the further away
    if (normal.x == 0.0 && normal.y > 0.0) box.upper_y = body.centre.y + wall.offset + margin;
    if (normal.x == 0.0 && normal.y < 0.0) box.lower_y = body.centre.y - wall.offset - margin;
    return box;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  if (placement_.is_swept && body.turn != 0.0 && std::isinf(store_->record(shape.body).bounding_radius)) {
    for (const Vec2 point : wall.points) margin = std::max(margin, std::abs(body.turn) * Norm(point) + body.reach);
  }
  for (const Vec2 point : wall.points) {
    const Vec2 p = body.centre + Turn(body, point);
    box = {std::min(box.lower_x, p.x - margin), std::min(box.lower_y, p.y - margin), std::max(box.upper_x, p.x + margin),
           std::max(box.upper_y, p.y + margin)};
  }
  return box;
}

void ContactFinder::UpdateCandidates() {
  std::erase_if(candidates_, [this](const Candidate& c) { return broad_phase_.IsTouched(c.a) || broad_phase_.IsTouched(c.b); });
  for (const Overlap& overlap : broad_phase_.FindOverlaps()) AddCandidate(overlap);
}

void ContactFinder::AddCandidate(const Overlap& overlap) {
  const std::int32_t row_one = placement_.shape(overlap.one).row, row_other = placement_.shape(overlap.other).row;
  // `one` shifted by k meets `other` where it is; so `other` is seen from `one` shifted by -k.
  if (row_one < row_other) candidates_.push_back({overlap.one, overlap.other, -overlap.shift});
  if (row_one > row_other) candidates_.push_back({overlap.other, overlap.one, overlap.shift});
}

/// By key: two stable counting sorts by rows, then the few candidates of the same two bodies by their shapes.
void ContactFinder::SortCandidates() {
  sorted_.resize(candidates_.size());
  const auto sort_by = [this](auto row_of) {
    first_.assign(store_->Rows().size() + 1, 0);
    for (const Candidate& c : candidates_) ++first_[static_cast<std::size_t>(row_of(c)) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    for (const Candidate& c : candidates_) sorted_[first_[static_cast<std::size_t>(row_of(c))]++] = c;
    candidates_.swap(sorted_);
  };
  sort_by([this](const Candidate& c) { return placement_.shape(c.b).row; });
  sort_by([this](const Candidate& c) { return placement_.shape(c.a).row; });
  const auto same_bodies = [this](const Candidate& p, const Candidate& q) {
    return placement_.shape(p.a).row == placement_.shape(q.a).row && placement_.shape(p.b).row == placement_.shape(q.b).row;
  };
  for (auto begin = candidates_.begin(), end = begin; begin != candidates_.end(); begin = end) {
    while (end != candidates_.end() && same_bodies(*begin, *end)) ++end;
    if (end - begin == 1) continue;
    std::sort(begin, end, [](const Candidate& p, const Candidate& q) {
      return std::tie(p.a, p.b, p.shift) < std::tie(q.a, q.b, q.shift);  // shapes of one body have rising indices
    });
  }
}

}  // namespace nscdd::box2d
