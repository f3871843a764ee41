// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/contact_kinematics.h"
#include "problem/subdomain_problem.h"

namespace nscdd {

// What contact_kinematics.h says, on the compact structures that the sweeps run through.

/// Relative velocity and impulse of a contact in its frame.
struct Local {
  double n = 0.0;
  double t = 0.0;
};

/// r of one contact; `impulse` points at its unknowns. r_t is zero without friction.
template <class Row>
inline Local ImpulseOf(const double* impulse) {
  return {impulse[0], HasFriction(Row::kModel) ? impulse[Unknowns(Row::kModel) - 1] : 0.0};
}

/// Its status, without friction open or sliding.
template <class Row>
inline ContactStatus StatusOf(const Row& c, const double* impulse) {
  const Local r = ImpulseOf<Row>(impulse);
  if constexpr (HasFriction(Row::kModel)) return StatusOf(Vec2{r.n, r.t}, c.friction);
  return StatusOf(Vec2{r.n, r.t}, 0.0);
}

/// v = H^T V of one contact; `va`, `vb` point at the velocities of its bodies. v_t is zero without friction.
template <class Row>
inline Local RelativeVelocity(const Row& c, const double* va, const double* vb) {
  const double dx = vb[0] - va[0], dy = vb[1] - va[1];
  Local v{c.n.x * dx + c.n.y * dy, 0.0};
  if constexpr (HasArms(Row::kModel)) v.n += c.turn_nb * vb[2] - c.turn_na * va[2];
  if constexpr (HasFriction(Row::kModel)) v.t = c.n.y * dx - c.n.x * dy + c.turn_tb * vb[2] - c.turn_ta * va[2];
  return v;
}

/// V += M^-1 H dr on both bodies; `ia`, `ib` point at their inverse masses.
template <class Row>
inline void AddImpulse(const Row& c, Local dr, const double* ia, const double* ib, double* va, double* vb) {
  // p = n dr_n + t dr_t acts on B, -p on A.
  double px = c.n.x * dr.n, py = c.n.y * dr.n;
  if constexpr (HasFriction(Row::kModel)) {
    px += c.n.y * dr.t;
    py -= c.n.x * dr.t;
  }
  va[0] -= ia[0] * px;
  va[1] -= ia[0] * py;
  vb[0] += ib[0] * px;
  vb[1] += ib[0] * py;
  if constexpr (Row::kModel == ContactModel::kFriction) {
    va[2] -= ia[1] * (c.turn_ta * dr.t);
    vb[2] += ib[1] * (c.turn_tb * dr.t);
  } else if constexpr (Row::kModel == ContactModel::kNormalArms) {
    va[2] -= ia[1] * (c.turn_na * dr.n);
    vb[2] += ib[1] * (c.turn_nb * dr.n);
  } else if constexpr (Row::kModel == ContactModel::kFrictionArms) {
    va[2] -= ia[1] * (c.turn_na * dr.n + c.turn_ta * dr.t);
    vb[2] += ib[1] * (c.turn_nb * dr.n + c.turn_tb * dr.t);
  }
}

/// W of one contact from the inverse masses of its bodies, each multiplied by `share` (1 / m_i gives undivided masses).
template <class Row>
inline Delassus DelassusBlock(const Row& c, const double* ia, const double* ib, double share_a = 1.0, double share_b = 1.0) {
  Delassus w;
  const double ma = ia[0] * share_a, mb = ib[0] * share_b;
  w.nn = ma + mb;
  if constexpr (Row::kModel != ContactModel::kNormal) {
    const double ja = ia[1] * share_a, jb = ib[1] * share_b;
    if constexpr (HasArms(Row::kModel)) w.nn += ja * c.turn_na * c.turn_na + jb * c.turn_nb * c.turn_nb;
    if constexpr (HasFriction(Row::kModel)) w.tt = ma + mb + ja * c.turn_ta * c.turn_ta + jb * c.turn_tb * c.turn_tb;
    if constexpr (Row::kModel == ContactModel::kFrictionArms) {
      w.nt = ja * c.turn_na * c.turn_ta + jb * c.turn_nb * c.turn_tb;
    }
  }
  return w;
}

}  // namespace nscdd
