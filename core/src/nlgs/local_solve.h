// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "problem/contact_frame.h"

namespace nscdd {

/// Exact solution of one contact with all other impulses fixed: with q = v - W r + (b_n, 0), find r such that
///     0 <= W_nn r_n + W_nt r_t + q_n  _|_  r_n >= 0,   Coulomb with  v_t = W_nt r_n + W_tt r_t + q_t.
/// Where W_nt = 0 exactly one of open, stick, slide holds and the result is a pair of projections (any friction >= 0).
inline Local SolveLocal(const NormalRow& c, Local r, Local v) {
  return {std::max(0.0, r.n - c.inverse_wnn * (v.n + c.offset)), 0.0};
}

inline Local SolveLocal(const NormalArmsRow& c, Local r, Local v) {
  return {std::max(0.0, r.n - c.inverse_wnn * (v.n + c.offset)), 0.0};
}

inline Local SolveLocal(const FrictionRow& c, Local r, Local v) {
  const double rn = std::max(0.0, r.n - c.inverse_wnn * (v.n + c.offset));
  const double bound = c.friction * rn;
  return {rn, std::min(bound, std::max(-bound, r.t - c.inverse_wtt * v.t))};
}

/// True where the contact with W_nt != 0 may have no solution or two (Painleve): mu |W_nt| >= W_nn.
inline bool IsPainleve(const FrictionArmsRow& c) { return c.friction * std::abs(c.wnt) >= c.wnn; }

/// Branches in the order open, stick, slide (+), slide (-); the first that holds is taken. If none holds by rounding, on the
/// edge of the cone, it slides the way that sticking points to; if none holds at all (Painleve), it opens: the residual then
/// says that the law is not met.
inline Local SolveLocal(const FrictionArmsRow& c, Local r, Local v) {
  const double qn = v.n + c.offset - c.wnn * r.n - c.wnt * r.t;
  const double qt = v.t - c.wnt * r.n - c.wtt * r.t;
  if (qn >= 0.0) return {};
  // Sticking: W r = -q in both components.
  const double determinant = c.wnn * c.wtt - c.wnt * c.wnt;
  const Local stick{(c.wnt * qt - c.wtt * qn) / determinant, (c.wnt * qn - c.wnn * qt) / determinant};
  if (stick.n >= 0.0 && std::abs(stick.t) <= c.friction * stick.n) return stick;
  // Sliding with r_t = -sign mu r_n: the normal equation gives r_n, and v_t must have that sign.
  for (const double sign : {1.0, -1.0}) {
    const double d = c.wnn + sign * c.friction * c.wnt;
    if (d <= 0.0) continue;
    const Local slide{-qn / d, -sign * c.friction * qn / d};
    if (sign * (c.wtt * slide.t + c.wnt * slide.n + qt) <= 0.0) return slide;
  }
  if (IsPainleve(c)) return {};
  const double sign = std::copysign(1.0, stick.t);
  const double rn = -qn / (c.wnn + sign * c.friction * c.wnt);
  return {rn, sign * c.friction * rn};
}

}  // namespace nscdd
