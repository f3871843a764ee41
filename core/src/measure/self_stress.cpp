// SPDX-License-Identifier: Apache-2.0
#include "nscdd/self_stress.h"

#include <cmath>
#include <numeric>

#include "nscdd/contact_kinematics.h"

namespace nscdd {
namespace {

double Norm2(const std::vector<double>& x) { return std::inner_product(x.begin(), x.end(), x.begin(), 0.0); }

/// A = M^-1/2 H D^-1/2 on the contacts that carry an impulse: P r = D^-1/2 times the part of D^1/2 r that A^T y misses.
class ScaledOperator {
 public:
  ScaledOperator(const ContactProblem& p, const std::vector<Vec2>& impulse) : problem_(p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      const bool free = !std::isinf(p.mass[i]);
      inverse_.push_back(free ? InverseMass{1.0 / p.mass[i], 1.0 / p.inertia[i]} : InverseMass{});
    }
    for (std::size_t c = 0; c < impulse.size(); ++c) {
      if (impulse[c].x == 0.0 && impulse[c].y == 0.0) continue;
      const ContactKinematics h = KinematicsOf(p.contacts, c);
      const Delassus w = DelassusOf(h, inverse_[p.contacts.a[c]], inverse_[p.contacts.b[c]]);
      contact_.push_back(c);
      kinematics_.push_back(h);
      root_.push_back({std::sqrt(w.nn), p.contacts.friction[c] > 0.0 ? std::sqrt(w.tt) : 0.0});
    }
  }

  std::size_t bodies() const { return inverse_.size(); }

  /// D^1/2 r.
  std::vector<double> Scaled(const std::vector<Vec2>& impulse) const {
    std::vector<double> x;
    for (std::size_t k = 0; k < contact_.size(); ++k) {
      x.insert(x.end(), {root_[k].x * impulse[contact_[k]].x, root_[k].y * impulse[contact_[k]].y});
    }
    return x;
  }

  std::vector<double> Times(const std::vector<double>& x) const {
    std::vector<Wrench> push(bodies());
    for (std::size_t k = 0; k < contact_.size(); ++k) {
      const std::size_t c = contact_[k];
      const Vec2 r{x[2 * k] / root_[k].x, root_[k].y > 0.0 ? x[2 * k + 1] / root_[k].y : 0.0};
      AddImpulse(kinematics_[k], r, &push[problem_.contacts.a[c]], &push[problem_.contacts.b[c]]);
    }
    std::vector<double> y;
    for (std::size_t i = 0; i < bodies(); ++i) {
      const double m = std::sqrt(inverse_[i].mass);
      y.insert(y.end(), {m * push[i].fx, m * push[i].fy, std::sqrt(inverse_[i].inertia) * push[i].torque});
    }
    return y;
  }

  std::vector<double> TransposedTimes(const std::vector<double>& y) const {
    const auto twist = [&](std::size_t i) {
      const double m = std::sqrt(inverse_[i].mass);
      return Twist{m * y[3 * i], m * y[3 * i + 1], std::sqrt(inverse_[i].inertia) * y[3 * i + 2]};
    };
    std::vector<double> x;
    for (std::size_t k = 0; k < contact_.size(); ++k) {
      const std::size_t c = contact_[k];
      const Vec2 v = RelativeVelocity(kinematics_[k], twist(problem_.contacts.a[c]), twist(problem_.contacts.b[c]));
      x.insert(x.end(), {v.x / root_[k].x, root_[k].y > 0.0 ? v.y / root_[k].y : 0.0});
    }
    return x;
  }

 private:
  const ContactProblem& problem_;
  std::vector<InverseMass> inverse_;
  std::vector<std::size_t> contact_;
  std::vector<ContactKinematics> kinematics_;
  std::vector<Vec2> root_;  // of W_nn, W_tt; 0: no friction
};

}  // namespace

double UndeterminedShare(const ContactProblem& problem, const std::vector<Vec2>& impulse) {
  const ScaledOperator a(problem, impulse);
  std::vector<double> rest = a.Scaled(impulse);
  const double whole = Norm2(rest);
  if (whole == 0.0) return 0.0;
  // Conjugate gradients on the normal equations of min |D^1/2 r - A^T y| (CGLS); what is left is the projection.
  std::vector<double> gradient = a.Times(rest), direction = gradient;
  double gamma = Norm2(gradient);
  const double enough = 1e-28 * whole;  // |A| is about 1: below is rounding
  for (std::size_t k = 0; k < 30 * a.bodies() && gamma > enough; ++k) {
    const std::vector<double> q = a.TransposedTimes(direction);
    const double step = gamma / Norm2(q);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= step * q[i];
    gradient = a.Times(rest);
    const double before = gamma;
    gamma = Norm2(gradient);
    for (std::size_t i = 0; i < direction.size(); ++i) direction[i] = gradient[i] + gamma / before * direction[i];
  }
  return std::sqrt(Norm2(rest) / whole);
}

}  // namespace nscdd
