// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "nscdd/contact_table.h"
#include "nscdd/motion_view.h"
#include "nscdd/sweep.h"

namespace nscdd {

/// The way of B's disk (A's, if the wall is B) as the other shape of row `c`, found at the beginning, sees it.
inline SweptDisk WayOf(const MotionView& motion, double period, const ContactTable& t, std::size_t c, bool wall_is_b) {
  const std::int32_t a = t.a[c], b = t.b[c];
  const Vec2 shift{t.has_images() ? t.image[c] * period : 0.0, 0.0};
  const Vec2 from = Centre(motion.pose[b]) + shift - Centre(motion.pose[a]);
  const Vec2 move = motion.dt * (Linear(motion.velocity[b]) - Linear(motion.velocity[a]));
  const Vec2 arm_a = t.has_arms() ? t.arm_a[c] : Vec2{}, arm_b = t.has_arms() ? t.arm_b[c] : Vec2{};
  const double turn_a = motion.dt * motion.velocity[a].spin, turn_b = motion.dt * motion.velocity[b].spin;
  const double radii = t.lever_a[c] + t.lever_b[c] - t.gap[c];
  if (wall_is_b) return {-1.0 * from, -1.0 * move, arm_b, arm_a, turn_b, turn_a, 0.0, radii};
  return {from, move, arm_a, arm_b, turn_a, turn_b, 0.0, radii};
}

/// Takes row `c`, found at the beginning of the motion, to the moment at which its shapes meet: disks, the corner or the
/// (unbounded) flat side of a wall. A flat side turns with its body.
inline void AdvanceToMeeting(const MotionView& motion, double period, std::size_t c, ContactTable* t) {
  const bool wall_is_b = t->lever_b[c] == 0.0 && t->lever_a[c] != 0.0, is_wall = wall_is_b || t->lever_a[c] == 0.0;
  SweptDisk way = WayOf(motion, period, *t, c, wall_is_b);
  const Vec2 normal = wall_is_b ? -1.0 * t->normal[c] : t->normal[c];  // from the wall, or from A
  struct Closest {
    Vec2 normal;
    double distance;
  };
  const auto of_point = [](Vec2 x) {
    const double distance = Norm(x);
    return Closest{distance > 0.0 ? (1.0 / distance) * x : Vec2{0.0, 1.0}, distance};
  };
  double moment = 0.0, distance = 0.0;
  Vec2 now = normal;
  if (t->flat[c]) {
    // In the axes of the wall its point under the disk stays where it is.
    const Vec2 on_wall = way.arm_a;
    way.shape_turn = way.turn_a;
    way.arm_a = {};
    way.turn_a = 0.0;
    const auto of_side = [&](Vec2 x) { return Closest{normal, Dot(normal, x - on_wall)}; };
    moment = ShapeMeeting(way, of_side);
    now = Rotate(moment * way.shape_turn, normal);
    distance = of_side(way.At(moment)).distance;
  } else {
    moment = way.Curvature() == 0.0 ? DiskMeeting(way.At(0.0), way.move, way.radius) : ShapeMeeting(way, of_point);
    const Closest closest = of_point(way.At(moment));
    now = closest.normal;
    distance = closest.distance;
  }
  if (moment == 0.0) return;
  const Vec2 disk_arm = Rotate(moment * way.turn_b, way.arm_b);
  const double gap = distance - way.radius;
  t->moment[c] = moment;
  t->normal[c] = wall_is_b ? -1.0 * now : now;
  if (is_wall) {
    if (!t->has_arms()) {
      t->arm_a.resize(t->size());
      t->arm_b.resize(t->size());
    }
    const Vec2 from_wall = way.from + moment * way.move + disk_arm;
    (wall_is_b ? t->lever_a : t->lever_b)[c] = distance;
    (wall_is_b ? t->arm_b : t->arm_a)[c] = from_wall - distance * now;
    (wall_is_b ? t->arm_a : t->arm_b)[c] = disk_arm;
  } else {
    t->lever_a[c] += 0.5 * (gap - t->gap[c]);
    t->lever_b[c] += 0.5 * (gap - t->gap[c]);
    if (t->has_arms()) {
      t->arm_a[c] = Rotate(moment * way.turn_a, way.arm_a);
      t->arm_b[c] = disk_arm;
    }
  }
  t->gap[c] = gap;
}

/// Whether the columns are there and rows are those of bodies; what is wrong besides does no harm.
inline bool IsReadable(const ContactTable& t, std::size_t bodies) {
  const std::size_t n = t.size();
  const auto is_row = [&](std::int32_t row) { return row >= 0 && static_cast<std::size_t>(row) < bodies; };
  return t.a.size() == n && t.b.size() == n && t.shape_a.size() == n && t.shape_b.size() == n && t.normal.size() == n &&
         t.lever_a.size() == n && t.lever_b.size() == n && t.site.size() == n && t.flat.size() == n && t.friction.size() == n &&
         t.restitution.size() == n && (t.image.empty() || t.image.size() == n) && t.arm_a.size() == t.arm_b.size() &&
         (t.arm_a.empty() || t.arm_a.size() == n) && std::all_of(t.a.begin(), t.a.end(), is_row) &&
         std::all_of(t.b.begin(), t.b.end(), is_row);
}

/// Turns what was found at the beginning of the motion into what SweepContacts() gives: drops what is beyond the reaches, takes
/// the rest to the moments at which the shapes meet. A table that breaks the contract of DetectContacts() is left to be
/// refused.
inline void AdvanceToMeetings(const MotionView& motion, double period, ContactTable* t) {
  if (!IsReadable(*t, motion.id.size())) return;
  std::size_t kept = 0;
  for (std::size_t c = 0; c < t->size(); ++c) {
    if (t->gap[c] > motion.reach[t->a[c]] + motion.reach[t->b[c]]) continue;
    t->ForEachColumn([&](auto& column) {
      if (!column.empty()) column[kept] = column[c];
    });
    ++kept;
  }
  t->ForEachColumn([&](auto& column) {
    if (!column.empty()) column.resize(kept);
  });
  t->moment.assign(kept, 0.0);
  for (std::size_t c = 0; c < kept; ++c) AdvanceToMeeting(motion, period, c, t);
}

}  // namespace nscdd
