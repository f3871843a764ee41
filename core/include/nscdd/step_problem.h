// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "nscdd/body_table.h"
#include "nscdd/contact_kinematics.h"
#include "nscdd/contact_table.h"
#include "nscdd/normal_law.h"
#include "nscdd/options.h"

namespace nscdd {

// What one step asks of a body and of a contact. The time stepper and whoever poses a step's problem from outside (export,
// tradeoff) take it from here: their problems are the same to the last bit.

inline InverseMass InverseMassOf(const BodyTable& bodies, std::size_t row) {
  if (bodies.kind[row] != BodyKind::kFree) return {};
  return {1.0 / bodies.mass[row], 1.0 / bodies.inertia[row]};
}

/// Velocity without contacts, V_f = V_i + dt M^-1 f  (M^-1 R_d of eq. (1)); prescribed bodies keep theirs.
inline Twist FreeVelocity(const BodyTable& bodies, std::size_t row, const InverseMass& inverse, double dt) {
  Twist v = bodies.velocity[row];
  if (bodies.kind[row] != BodyKind::kFree) return v;
  const Wrench& f = bodies.force[row];
  v.vx += dt * inverse.mass * f.fx;
  v.vy += dt * inverse.mass * f.fy;
  v.spin += dt * inverse.inertia * f.torque;
  return v;
}

/// Normal side of one contact's law.
struct NormalCondition {
  double approach = 0.0;  ///< v_n before the step [m/s]; negative when closing
  double offset = 0.0;    ///< b_n [m/s]
};

inline NormalCondition NormalConditionOf(const SteppingOptions& stepping, const BodyTable& bodies, const ContactTable& contacts,
                                         std::size_t c, double dt) {
  const double approach =
      RelativeVelocity(KinematicsOf(contacts, c), bodies.velocity[contacts.a[c]], bodies.velocity[contacts.b[c]]).x;
  const double levers = contacts.lever_a[c] + contacts.lever_b[c];
  return {approach, NormalOffset(stepping, contacts.gap[c], levers, approach, contacts.restitution[c], dt)};
}

}  // namespace nscdd
