// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "nscdd/contact_table.h"
#include "nscdd/vector.h"

namespace nscdd {

/// The columns of the compatibility operator H of one contact (v = H^T V, R = H r: Visseq, Alart and Dureisseix, section 1), in
/// the conventions of ContactTable:
///     on B: H_n = (n, turn_nb), H_t = (t, turn_tb);   on A: H_n = -(n, turn_na), H_t = -(t, turn_ta)
///     turn_n = arm x n;  turn_tb = arm_b x t + lever_b,  turn_ta = arm_a x t - lever_a      [m]
struct ContactKinematics {
  Vec2 n, t;
  double turn_na, turn_nb;
  double turn_ta, turn_tb;
};

inline ContactKinematics KinematicsOf(const ContactTable& table, std::size_t contact) {
  const Vec2 n = table.normal[contact], t{n.y, -n.x};
  const Vec2 arm_a = table.has_arms() ? table.arm_a[contact] : Vec2{}, arm_b = table.has_arms() ? table.arm_b[contact] : Vec2{};
  return {n,
          t,
          Cross(arm_a, n),
          Cross(arm_b, n),
          Cross(arm_a, t) - table.lever_a[contact],
          Cross(arm_b, t) + table.lever_b[contact]};
}

/// (v_n, v_t) = H^T V [m/s] from the velocities of A and B.
inline Vec2 RelativeVelocity(const ContactKinematics& c, const Twist& a, const Twist& b) {
  const double dx = b.vx - a.vx, dy = b.vy - a.vy;
  return {c.n.x * dx + c.n.y * dy + (c.turn_nb * b.spin - c.turn_na * a.spin),
          c.t.x * dx + c.t.y * dy + c.turn_tb * b.spin - c.turn_ta * a.spin};
}

/// Adds H r [N s, N m s] of the impulse r = (r_n, r_t) to what A and B receive.
inline void AddImpulse(const ContactKinematics& c, Vec2 r, Wrench* a, Wrench* b) {
  const Vec2 p = r.x * c.n + r.y * c.t;
  *a = {a->fx - p.x, a->fy - p.y, a->torque - c.turn_na * r.x - c.turn_ta * r.y};
  *b = {b->fx + p.x, b->fy + p.y, b->torque + c.turn_nb * r.x + c.turn_tb * r.y};
}

/// 1/M [1/kg] and 1/I [1/(kg m^2)] of a body; both 0 where its motion is prescribed.
struct InverseMass {
  double mass = 0.0;
  double inertia = 0.0;
};

/// Diagonal block of the Delassus operator, W = H^T M^-1 H [1/kg].
struct Delassus {
  double nn = 0.0;
  double nt = 0.0;
  double tt = 0.0;
};

inline Delassus DelassusOf(const ContactKinematics& c, const InverseMass& a, const InverseMass& b) {
  const double m = a.mass + b.mass;
  return {m + (a.inertia * c.turn_na * c.turn_na + b.inertia * c.turn_nb * c.turn_nb),
          a.inertia * c.turn_na * c.turn_ta + b.inertia * c.turn_nb * c.turn_tb,
          m + a.inertia * c.turn_ta * c.turn_ta + b.inertia * c.turn_tb * c.turn_tb};
}

}  // namespace nscdd
