// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "nscdd/contact_kinematics.h"
#include "nscdd/vector.h"

namespace nscdd {

// The natural residuals of a contact problem, with undivided masses:
//     e_c = r_c - P_K(r_c - rho_c (v_n + b_n + mu |v_t|, v_t)),   rho_c = 1 / max(W_nn, W_tt)  (1 / W_nn without friction)
//     P_K: projection on the Coulomb cone |r_t| <= mu r_n;  without friction P(z) = max(0, z_n)
//     nat = ||e|| / max(||r||, 1e-3 ||dt f||);   0 without contacts
//     nat_max = max over contacts of max(e_n, e_t) / velocity scale, with  e_n = |min(v_n + b_n, W_nn r_n)|,
//               e_t = |W_tt r_t - clamp(W_tt r_t - v_t, +-W_tt mu max(r_n, 0))|;   0 when the scale vanishes

/// Minimum and maximum that are NaN when one of the two is.
inline double Smaller(double a, double b) { return a < b || std::isnan(a) ? a : b; }
inline double Larger(double a, double b) { return a > b || std::isnan(a) ? a : b; }

/// Projection on the Coulomb cone; mu = 0 is its half-line. Not a number stays not a number.
inline Vec2 ProjectOnCone(Vec2 z, double mu) {
  if (mu == 0.0) return {z.x <= 0.0 ? 0.0 : z.x, 0.0};
  const double zt = std::abs(z.y);
  if (zt <= mu * z.x) return z;
  if (mu * zt <= -z.x) return {};
  const double n = (z.x + mu * zt) / (1.0 + mu * mu);
  return {n, std::copysign(mu * n, z.y)};
}

/// Part of one contact.
struct NaturalError {
  double e2 = 0.0;     ///< |e_c|^2 [N^2 s^2]
  double speed = 0.0;  ///< max(e_n, e_t) [m/s]
};

/// `w`: block of the Delassus operator, `offset`: b_n, `r` = (r_n, r_t), `v` = (v_n, v_t).
inline NaturalError NaturalErrorOf(const Delassus& w, double offset, double mu, Vec2 r, Vec2 v) {
  // De Saxce's shift mu |v_t| of the normal velocity makes the law of friction a projection on one cone.
  const double gap_speed = v.x + offset;
  const double rho = 1.0 / (mu > 0.0 ? std::max(w.nn, w.tt) : w.nn);
  const Vec2 p = ProjectOnCone({r.x - rho * (gap_speed + mu * std::abs(v.y)), mu > 0.0 ? r.y - rho * v.y : 0.0}, mu);
  const double en = r.x - p.x, et = r.y - p.y, e2 = en * en + et * et;
  const double normal = std::abs(Smaller(gap_speed, w.nn * r.x));
  if (mu == 0.0) return {e2, Larger(normal, w.tt * std::abs(r.y))};
  const double bound = w.tt * mu * std::max(r.x, 0.0);
  return {e2, Larger(normal, std::abs(w.tt * r.y - std::clamp(w.tt * r.y - v.y, -bound, bound)))};
}

/// nat from the sums of |e_c|^2 and |r_c|^2; `load`: ||dt f|| [N s].
inline double Nat(double sum_e2, double sum_r2, double load) {
  if (sum_e2 == 0.0) return 0.0;
  if (!std::isfinite(sum_r2)) return NAN;  // an overflow is no small residual
  return std::sqrt(sum_e2) / std::max(std::sqrt(sum_r2), 1e-3 * load);
}

/// nat_max from the largest speed and its scale [m/s].
inline double NatMax(double worst, double scale) {
  if (scale == 0.0) return std::isfinite(worst) ? 0.0 : worst;
  return worst / scale;
}

}  // namespace nscdd
