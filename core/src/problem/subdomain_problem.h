// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd {

/// Which unknowns the scene requires; the same for all subdomains of a step.
enum class ContactModel {
  kNormal,       ///< disks without friction: r_n; velocities (vx, vy), a spin cannot change
  kNormalArms,   ///< clusters without friction: r_n; velocities (vx, vy, w)
  kFriction,     ///< disks with friction: (r_n, r_t); W_nt = 0
  kFrictionArms  ///< clusters with friction: (r_n, r_t); W_nt != 0
};

constexpr ContactModel ModelWith(bool friction, bool arms) {
  if (friction) return arms ? ContactModel::kFrictionArms : ContactModel::kFriction;
  return arms ? ContactModel::kNormalArms : ContactModel::kNormal;
}
constexpr bool HasFriction(ContactModel m) { return m == ContactModel::kFriction || m == ContactModel::kFrictionArms; }
constexpr bool HasArms(ContactModel m) { return m == ContactModel::kNormalArms || m == ContactModel::kFrictionArms; }
/// Velocity components of a body.
constexpr int Dofs(ContactModel m) { return m == ContactModel::kNormal ? 2 : 3; }
/// Impulse components of a contact.
constexpr int Unknowns(ContactModel m) { return HasFriction(m) ? 2 : 1; }
/// Inverse masses of a body: 1/m, and 1/I when it can turn.
constexpr int Inertias(ContactModel m) { return Dofs(m) - 1; }

/// Constants of one contact in a sweep, one structure a model; a, b are rows of the subdomain's bodies (A, B of ContactTable).
/// The columns of H are (t = (n_y, -n_x)):
///     on B: H_n = (n, turn_nb), H_t = (t, turn_tb);   on A: H_n = -(n, turn_na), H_t = -(t, turn_ta)
///     turn_n = arm x n;  turn_tb = arm_b x t + lever_b,  turn_ta = arm_a x t - lever_a
/// W = H^T M~^-1 H is the 2x2 diagonal block of the Delassus operator with the subdomain's divided masses.
struct NormalRow {
  static constexpr ContactModel kModel = ContactModel::kNormal;
  std::int32_t a, b;
  Vec2 n;
  double inverse_wnn;
  double offset;  // b_n
};

struct NormalArmsRow {
  static constexpr ContactModel kModel = ContactModel::kNormalArms;
  std::int32_t a, b;
  Vec2 n;
  double turn_na, turn_nb;
  double inverse_wnn;
  double offset;
};

struct FrictionRow {
  static constexpr ContactModel kModel = ContactModel::kFriction;
  std::int32_t a, b;
  Vec2 n;
  double turn_ta, turn_tb;  // -lever_a, lever_b
  double inverse_wnn, inverse_wtt;
  double offset;
  double friction;
};

struct FrictionArmsRow {
  static constexpr ContactModel kModel = ContactModel::kFrictionArms;
  std::int32_t a, b;
  Vec2 n;
  double turn_na, turn_nb, turn_ta, turn_tb;
  double wnn, wnt, wtt;
  double offset;
  double friction;
};

/// One subdomain E of one step: constant during a solve. Body i of multiplicity m_i is here as a copy with mass M~ = M / m_i.
///
/// Balance (math: eq. (7) of Visseq, Alart and Dureisseix; this is its only statement):
///     M~_E V_E = M~_E V_f + H_E r_E - F_E,    v_E = H_E^T V_E,
///     0 <= v_n + b_n  _|_  r_n >= 0,   |r_t| <= mu r_n,  v_t != 0 => r_t = -mu r_n sign(v_t);
/// F_E (interface impulse, zero sum over the copies of a body) makes the copies agree:  V_E = V_E' for all E, E' of a body.
/// Prescribed bodies have M~^-1 = 0; one that turns is here once per contact, with the velocity of the touching point, so no
/// row of H needs an arm for it.
struct SubdomainProblem {
  ContactModel model = ContactModel::kNormal;
  int subdomain = 0;  ///< number E among all

  std::vector<std::int32_t> body;          ///< row of each copy in the rank's table of bodies
  std::vector<double> inverse_mass;        ///< Inertias(model) per copy: m_i / M [1/kg], m_i / I [1/(kg m^2)]
  std::vector<double> free_velocity;       ///< V_f, Dofs(model) per copy
  std::vector<std::int32_t> multiplicity;  ///< m_i of each copy; empty when all are 1

  std::vector<std::int32_t> contact;       ///< row of each contact in the rank's table of contacts, in the order of the sweep
  std::vector<std::int32_t> packet_begin;  ///< PacketOrder::begin of that order
  std::vector<NormalRow> normal;           // the one that the model names is filled
  std::vector<NormalArmsRow> normal_arms;
  std::vector<FrictionRow> friction;
  std::vector<FrictionArmsRow> friction_arms;

  std::size_t body_count() const { return body.size(); }
  std::size_t contact_count() const { return contact.size(); }
};

/// What changes during a solve.
struct SubdomainState {
  std::vector<double> velocity;  ///< V_E, Dofs(model) per copy
  std::vector<double> impulse;   ///< r_E, Unknowns(model) per contact
};

/// The rows that the model names. `Visit(problem, f)` calls f with std::vector<Row>&.
template <class Problem, class Function>
decltype(auto) VisitRows(Problem& problem, Function&& function) {
  switch (problem.model) {
    case ContactModel::kNormal:
      return function(problem.normal);
    case ContactModel::kNormalArms:
      return function(problem.normal_arms);
    case ContactModel::kFriction:
      return function(problem.friction);
    case ContactModel::kFrictionArms:
      break;
  }
  return function(problem.friction_arms);
}

}  // namespace nscdd
