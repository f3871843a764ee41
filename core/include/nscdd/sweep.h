// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "nscdd/vector.h"

namespace nscdd {

// When two shapes meet on their way through a step: for adapters, which know the shapes. Time t runs from 0 to 1 over the step.

/// A gap below this part of the radii is closed: what rounding and the solver leave of a contact.
constexpr double kClosedGap = 1e-9;

/// A disk of body B on its way, as a convex shape of body A sees it. Its centre, from A's centre of mass and in axes that turn
/// with the shape, is
///     x(t) = R(-t shape_turn) (from + t move + R(t turn_b) arm_b - R(t turn_a) arm_a).
/// The shape is a disk: arm_a leads to its centre, the axes stay (shape_turn = 0). Any other: arm_a = 0, shape_turn = A's turn.
struct SweptDisk {
  Vec2 from;  ///< [m] from A's centre of mass to B's, at t = 0
  Vec2 move;  ///< [m] of B's centre of mass minus A's over the step
  Vec2 arm_a, arm_b;
  double turn_a = 0.0, turn_b = 0.0;  ///< [rad] over the step
  double shape_turn = 0.0;
  double radius = 0.0;  ///< [m] of the disk, and of A's where the shape is one

  Vec2 At(double t) const {
    const Vec2 x = from + t * move + Turned(t * turn_b, arm_b) - Turned(t * turn_a, arm_a);
    return Turned(-t * shape_turn, x);
  }

  /// dx/dt
  Vec2 Rate(double t) const {
    const Vec2 b = Turned(t * turn_b, arm_b), a = Turned(t * turn_a, arm_a);
    const Vec2 x = from + t * move + b - a, rate = move + turn_b * Vec2{-b.y, b.x} - turn_a * Vec2{-a.y, a.x};
    return Turned(-t * shape_turn, rate - shape_turn * Vec2{-x.y, x.x});
  }

  /// Bound on |d2x/dt2|; 0: the way is straight.
  double Curvature() const {
    if (shape_turn == 0.0) return turn_b * turn_b * Norm(arm_b) + turn_a * turn_a * Norm(arm_a);
    const double turn = turn_b - shape_turn, speed = Norm(move);
    return turn * turn * Norm(arm_b) + shape_turn * shape_turn * (Norm(from) + speed) + 2.0 * std::abs(shape_turn) * speed;
  }

 private:
  static Vec2 Turned(double turn, Vec2 a) { return turn == 0.0 || (a.x == 0.0 && a.y == 0.0) ? a : Rotate(turn, a); }
};

/// Moment at which disks whose centres part by `between`, and approach straight by `move` over the step, touch; if they do not,
/// that at which they are closest. 0 if their gap is closed at the beginning. `radii`: the sum of both.
inline double DiskMeeting(Vec2 between, Vec2 move, double radii) {
  const double approach = -Dot(between, move), square = Dot(between, between), closed = radii * (1.0 + kClosedGap);
  if (approach <= 0.0 || square <= closed * closed) return 0.0;
  // |between + t move| = radii, the first root.
  const double speed2 = Dot(move, move), root2 = approach * approach - speed2 * (square - radii * radii);
  return std::min(1.0, root2 >= 0.0 ? (square - radii * radii) / (approach + std::sqrt(root2)) : approach / speed2);
}

/// The same for any way and any convex shape. `closest(x)` returns, for a point in the shape's axes, an object with `normal`
/// (unit, from the shape to x) and `distance` [m]. Advances by steps in which the gap cannot close: with k the curvature of the
/// way, and since the distance to a convex shape is a convex function,
///     gap(t + s) >= gap + s gap' - k s^2 / 2.
/// Where the way is straight this is Newton's iteration from the safe side.
/// Where the way turns by as much as counts, and ends with a small overlap on the same side, the moment is the end: there the
/// half-plane is exact.
template <class Closest>
double ShapeMeeting(const SweptDisk& way, Closest closest) {
  struct State {
    double t, gap, rate;
    Vec2 normal;
  };
  const auto at = [&](double t) {
    const auto c = closest(way.At(t));
    return State{t, c.distance - way.radius, Dot(c.normal, way.Rate(t)), c.normal};
  };
  const auto touch = [&](const State& now) {
    if (0.5 * way.Curvature() < 1e-4 * way.radius || now.gap < -1e-3 * way.radius) return now.t;
    const State end = at(1.0);
    const double side = Dot(end.normal, now.normal);
    const bool wall_turns = way.turn_b == 0.0 || Norm(way.arm_b) == 0.0;  // and so does not the disk: exact from any depth
    const bool ends_there = (wall_turns && side > 0.9) || (side > 0.0 && end.gap > -0.1 * way.radius);
    return ends_there && end.gap < now.gap - 1e-5 * way.radius ? 1.0 : now.t;
  };
  const double curvature = way.Curvature(), touching = 1e-3 * kClosedGap * way.radius;
  State now = at(0.0);
  if (now.gap <= kClosedGap * way.radius) return touch(now);
  if (curvature == 0.0 && !(now.rate < 0.0)) return 0.0;
  State nearest = now;
  for (int i = 0; i < 64; ++i) {
    const double root = std::sqrt(now.rate * now.rate + 2.0 * curvature * now.gap);
    const double step = now.rate < 0.0 ? 2.0 * now.gap / (root - now.rate) : (root + now.rate) / curvature;
    State next = at(now.t + step < 1.0 ? now.t + step : 1.0);  // an infinite step too
    if (next.gap <= touching) return touch(next);
    // The gap is least where its rate changes its sign, or at the end.
    State least = next;
    if (now.rate < 0.0 && next.rate > 0.0) {
      State low = now, high = next;
      for (int k = 0; k < 40; ++k) {
        least = at(0.5 * (low.t + high.t));
        (least.rate < 0.0 ? low : high) = least;
      }
    }
    if (least.gap < nearest.gap) nearest = least;
    if (next.t >= 1.0 || (curvature == 0.0 && next.rate > 0.0)) return nearest.t;
    now = next;
  }
  return now.t;
}

}  // namespace nscdd
