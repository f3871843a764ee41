// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/communicator.h"
#include "nscdd/contact_kinematics.h"
#include "nscdd/contact_problem.h"
#include "nscdd/contact_table.h"
#include "nscdd/normal_law.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"
#include "nscdd/sweep.h"

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

/// (V_i + V_f) / 2 [m/s, rad/s]: what moves a body through a step that nothing hinders, exactly under constant loads.
inline Twist FreeMotion(const BodyTable& bodies, std::size_t row, double dt) {
  const Twist &before = bodies.velocity[row], after = FreeVelocity(bodies, row, InverseMassOf(bodies, row), dt);
  return {0.5 * (before.vx + after.vx), 0.5 * (before.vy + after.vy), 0.5 * (before.spin + after.spin)};
}

/// Gap that the half-plane of contact `c` leaves at the beginning of the step [m]: a motion W keeps the bodies apart when
///     gap + dt w_n >= 0.
/// The half-plane touches the shapes where they are at the row's moment, on the way `path` of the sweep.
inline double LinearGap(const ContactTable& contacts, std::size_t c, std::span<const Twist> path, double dt) {
  const double moment = contacts.MomentOf(c);
  if (moment == 0.0) return contacts.gap[c];
  const Vec2 v = RelativeVelocity(KinematicsOf(contacts, c), path[contacts.a[c]], path[contacts.b[c]]);
  return contacts.gap[c] - moment * dt * v.x;
}

/// Whether contact `c` is closed, or closes on the way `path`: it hinders its bodies. The displacement problem of two stages
/// starts from V_f for these, so that W is their velocity at the end as well, and from FreeMotion() for the others.
inline bool Closes(const ContactTable& contacts, std::size_t c, std::span<const Twist> path, double dt) {
  const Vec2 v = RelativeVelocity(KinematicsOf(contacts, c), path[contacts.a[c]], path[contacts.b[c]]);
  const double levers = contacts.lever_a[c] + contacts.lever_b[c];
  return contacts.gap[c] + dt * (std::min(0.0, v.x) - contacts.MomentOf(c) * v.x) <= kClosedGap * levers;
}

/// Normal side of one contact's law.
struct NormalCondition {
  double approach = 0.0;  ///< v_n before the step [m/s]; negative when closing
  double offset = 0.0;    ///< b_n [m/s]
};

/// `path`: velocities at which the bodies went through the sweep, by row; not read by the laws of one stage. Of two stages this
/// is the first, that of displacements.
inline NormalCondition NormalConditionOf(const SteppingOptions& stepping, const BodyTable& bodies, std::span<const Twist> path,
                                         const ContactTable& contacts, std::size_t c, double dt) {
  const double approach =
      RelativeVelocity(KinematicsOf(contacts, c), bodies.velocity[contacts.a[c]], bodies.velocity[contacts.b[c]]).x;
  if (HasTwoStages(stepping.normal_law)) {
    // An overlap that is there is left alone; one that a turning way would end with is not.
    const double gap = LinearGap(contacts, c, path, dt);
    return {approach, (contacts.MomentOf(c) > 0.0 ? gap : std::max(0.0, gap)) / dt};
  }
  const double levers = contacts.lever_a[c] + contacts.lever_b[c];
  return {approach, NormalOffset(stepping, contacts.gap[c], levers, approach, contacts.restitution[c], dt)};
}

/// Interpenetration [m] at a gap.
inline double Depth(double gap) { return std::max(0.0, -gap); }

/// By how much the relative velocity v_n of a step of `dt` [s] deepens a contact that is detected at `gap` [m].
inline double DepthGrowth(double gap, double vn, double dt) { return std::max(0.0, Depth(gap + dt * vn) - Depth(gap)); }

/// A tenth of the mean disk radius of all ranks' free bodies [m], each on one rank; negative while there are none. Collective.
/// Radii are summed as multiples of 2^-26 of the largest: exact in any order, so the same on any number of ranks.
double DefaultAlertDistance(const BodyTable& bodies, Communicator* communicator);

/// The poses after `dt` [s] at constant velocity, taken into the platform's period.
std::vector<Pose> Drifted(const std::vector<Pose>& pose, const std::vector<Twist>& velocity, double dt,
                          const AdapterDescription& platform);

/// The table with its rows in ascending order of id.
BodyTable SortedById(const BodyTable& bodies);

/// The contact problem of a step of `dt` [s] as the TimeStepper makes it, from what an adapter said: V_f, b_n, scales; of two
/// stages the first, that of displacements. `bodies` at the beginning of the step, the rows of `contacts`; `motion`: velocities
/// of the sweep (not read by laws of one stage). Contacts that the normal law does not see are left out; subdomains are left to
/// the solver.
ContactProblem PoseStep(const BodyTable& bodies, std::span<const Twist> motion, const ContactTable& contacts,
                        const SteppingOptions& stepping, double dt);

/// The contact problem of one step as the TimeStepper makes it, read from outside: for answers that are not its own.
struct StepProblem {
  BodyTable bodies;              ///< at the beginning of the step, ascending ids
  std::vector<Pose> detection;   ///< q_m = q_i + (1 - theta) dt V_i, by row of bodies
  ContactProblem problem;        ///< same rows; subdomains are left to the solver
  std::vector<ContactKey> keys;  ///< of its contacts, ascending
  SteppingOptions stepping;
  double dt = 0.0;  ///< [s]
};

/// From what the adapter's host holds now. Throws Error unless stepping.alert_distance >= 0 and the law keeps open contacts.
StepProblem ReadStepProblem(PlatformAdapter* adapter, const SteppingOptions& stepping, double dt);

/// All bodies of the adapter's host in ascending order of id.
BodyTable ReadSortedBodies(PlatformAdapter* adapter);

}  // namespace nscdd
