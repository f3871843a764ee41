// SPDX-License-Identifier: Apache-2.0
#include "nscdd/answer_measures.h"

#include <algorithm>
#include <cmath>

#include "nscdd/contact_kinematics.h"
#include "nscdd/natural_residual.h"

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
    const NaturalError error = NaturalErrorOf(w, p.offset[c], t.friction[c], r, v);
    e2 += error.e2;
    r2 += Dot(r, r);
    worst = Larger(error.speed, worst);
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
  result.nat = Nat(e2, r2, scales.impulse);
  result.nat_max = NatMax(worst, speed);
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
    worst = Larger(d2, worst);
  }
  const double energy = scales.energy > 0.0 ? scales.energy : std::max(scales.mass, 1e-300);
  return {std::sqrt(sum / energy), std::sqrt(worst) / (scales.velocity > 0.0 ? scales.velocity : 1.0)};
}

SampleTotals TotalsOf(const ContactProblem& p, const std::vector<Twist>& velocity, const std::vector<Pose>& pose) {
  SampleTotals s;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (!IsFree(p, i)) continue;
    const Twist& v = velocity[i];
    s.leftmost = s.mass == 0.0 ? pose[i].x : std::min(s.leftmost, pose[i].x);
    s.rightmost = s.mass == 0.0 ? pose[i].x : std::max(s.rightmost, pose[i].x);
    s.mass += p.mass[i];
    s.kinetic_energy += 0.5 * (p.mass[i] * (v.vx * v.vx + v.vy * v.vy) + p.inertia[i] * v.spin * v.spin);
    s.momentum = s.momentum + p.mass[i] * Linear(v);
    s.centre = s.centre + p.mass[i] * Centre(pose[i]);
  }
  if (s.mass > 0.0) s.centre = (1.0 / s.mass) * s.centre;
  return s;
}

Vec2 ImpulseOnWalls(const ContactProblem& p, const std::vector<Vec2>& impulse) {
  Vec2 sum;
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    Wrench a, b;
    AddImpulse(KinematicsOf(p.contacts, c), impulse[c], &a, &b);
    if (!IsFree(p, p.contacts.a[c])) sum = sum + Vec2{a.fx, a.fy};
    if (!IsFree(p, p.contacts.b[c])) sum = sum + Vec2{b.fx, b.fy};
  }
  return sum;
}

}  // namespace nscdd
