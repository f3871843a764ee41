// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/answer_residuals.h"

#include <algorithm>
#include <cmath>

#include "nscdd/contact_kinematics.h"

namespace nscdd {
namespace {

bool IsFree(const ContactProblem& p, std::size_t i) { return !std::isinf(p.mass[i]); }
InverseMass InverseMassOf(const ContactProblem& p, std::size_t i) {
  return IsFree(p, i) ? InverseMass{1.0 / p.mass[i], 1.0 / p.inertia[i]} : InverseMass{};
}
double Square(double x) { return x * x; }

struct Scales {
  double impulse = 0.0;   // ||dt f||, translations [N s]
  double energy = 0.0;    // |dt f|^2_{M^-1} [J]
  double velocity = 0.0;  // largest |dt f| / m [m/s]
  double mass = 0.0;      // of all free bodies [kg]
};

Scales ScalesOf(const ContactProblem& p) {
  Scales s;
  double sum = 0.0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (!IsFree(p, i)) continue;
    const double f2 = Square(p.impulse[i].fx) + Square(p.impulse[i].fy);
    sum += f2;
    s.energy += f2 / p.mass[i];
    s.velocity = std::max(s.velocity, std::sqrt(f2) / p.mass[i]);
    s.mass += p.mass[i];
  }
  s.impulse = std::sqrt(sum);
  return s;
}

/// Projection on the Coulomb cone |z_t| <= mu z_n; a half-line without friction.
Vec2 ProjectOnCone(Vec2 z, double mu) {
  if (mu == 0.0) return {z.x <= 0.0 ? 0.0 : z.x, 0.0};
  const double zt = std::abs(z.y);
  if (zt <= mu * z.x) return z;
  if (mu * zt <= -z.x) return {};
  const double n = (z.x + mu * zt) / (1.0 + mu * mu);
  return {n, std::copysign(mu * n, z.y)};
}

struct ContactErrors {
  double e2 = 0.0;     // |r - P_K(r - rho (v_n + b_n + mu |v_t|, v_t))|^2
  double worst = 0.0;  // [m/s]
};

ContactErrors ErrorsOf(const Delassus& w, double offset, double mu, Vec2 r, Vec2 v) {
  const double opening = v.x + offset;
  const double rho = 1.0 / (mu > 0.0 ? std::max(w.nn, w.tt) : w.nn);
  const Vec2 moved{r.x - rho * (opening + mu * std::abs(v.y)), mu > 0.0 ? r.y - rho * v.y : 0.0};
  const Vec2 e = r - ProjectOnCone(moved, mu);
  const double normal = std::abs(std::min(opening, w.nn * r.x));
  const double bound = w.tt * mu * std::max(r.x, 0.0);
  const double tangent = mu > 0.0 ? std::abs(w.tt * r.y - std::clamp(w.tt * r.y - v.y, -bound, bound)) : w.tt * std::abs(r.y);
  const double worst = std::max(normal, tangent);
  return {Dot(e, e), std::isnan(normal + tangent) ? normal + tangent : worst};
}

}  // namespace

AnswerResiduals MeasureAnswer(const ContactProblem& p, const Answer& answer, const std::vector<bool>& measured) {
  const Scales scales = ScalesOf(p);
  const ContactTable& t = p.contacts;
  std::vector<Wrench> push(p.mass.size());
  double e2 = 0.0, r2 = 0.0, worst = 0.0, work = 0.0;
  for (std::size_t c = 0; c < t.size(); ++c) {
    const std::size_t a = t.a[c], b = t.b[c];
    const ContactKinematics h = KinematicsOf(t, c);
    const Vec2 r = answer.impulse[c], v = RelativeVelocity(h, answer.velocity[a], answer.velocity[b]);
    AddImpulse(h, r, &push[a], &push[b]);
    if (!measured.empty() && !measured[c]) continue;
    const Delassus w = DelassusOf(h, InverseMassOf(p, a), InverseMassOf(p, b));
    const ContactErrors errors = ErrorsOf(w, p.offset[c], t.friction[c], r, v);
    e2 += errors.e2;
    r2 += Dot(r, r);
    if (!(errors.worst <= worst)) worst = errors.worst;
    work += r.x * (v.x + p.offset[c]) + r.y * v.y + t.friction[c] * r.x * std::abs(v.y);
  }
  double defect = 0.0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (!IsFree(p, i)) continue;
    const Twist &v = answer.velocity[i], &f = p.free_velocity[i];
    defect += Square(p.mass[i] * (v.vx - f.vx) - push[i].fx) / p.mass[i] +
              Square(p.mass[i] * (v.vy - f.vy) - push[i].fy) / p.mass[i] +
              Square(p.inertia[i] * (v.spin - f.spin) - push[i].torque) / p.inertia[i];
  }
  double speed = std::max(scales.velocity, p.approach_speed);
  for (const double offset : p.offset) speed = std::max(speed, -offset);  // speeds of recovery
  AnswerResiduals result;
  result.nat = e2 == 0.0 ? 0.0 : std::isfinite(r2) ? std::sqrt(e2) / std::max(std::sqrt(r2), 1e-3 * scales.impulse) : NAN;
  result.nat_max = speed > 0.0 ? worst / speed : 0.0;
  result.momentum_defect = scales.energy > 0.0 ? std::sqrt(defect / scales.energy) : 0.0;
  result.energy_defect = scales.energy > 0.0 ? work / scales.energy : 0.0;
  return result;
}

VelocityError CompareVelocities(const ContactProblem& p, const std::vector<Twist>& velocity, const std::vector<Twist>& other) {
  const Scales scales = ScalesOf(p);
  double sum = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (!IsFree(p, i)) continue;
    const Twist &v = velocity[i], &u = other[i];
    const double d2 = Square(v.vx - u.vx) + Square(v.vy - u.vy) + p.inertia[i] / p.mass[i] * Square(v.spin - u.spin);
    sum += p.mass[i] * d2;
    if (!(d2 <= worst)) worst = d2;
  }
  const double energy = scales.energy > 0.0 ? scales.energy : std::max(scales.mass, 1e-300);
  return {std::sqrt(sum / energy), std::sqrt(worst) / (scales.velocity > 0.0 ? scales.velocity : 1.0)};
}

}  // namespace nscdd
