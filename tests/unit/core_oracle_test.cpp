// SPDX-License-Identifier: Apache-2.0
// The natural residuals once more, from their equations alone (nscdd/natural_residual.h, nscdd/contact_table.h): dense
// matrices, torques about the centres of mass, the projection by search. Whoever else measures residuals must agree.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "nscdd/answer_measures.h"
#include "nscdd/contact_operators.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

struct Oracle {
  Matrix transfer;      // H: rows vx, vy, spin of every body, columns n, t of every contact
  Vector inverse_mass;  // diagonal of M^-1; 0 of prescribed motion
  double nat = 0.0, nat_max = 0.0, momentum_defect = 0.0;
};

/// The nearest of the cone's points: inside, the apex, or a foot on one of its two edges.
Vec2 Nearest(Vec2 z, double mu) {
  if (z.x >= 0.0 && std::abs(z.y) <= mu * z.x) return z;
  Vec2 best{};
  for (const double side : {-1.0, 1.0}) {
    const double length = std::hypot(1.0, mu);
    const Vec2 edge{1.0 / length, side * mu / length};
    const Vec2 foot = std::max(0.0, Dot(z, edge)) * edge;
    if (Norm(z - foot) < Norm(z - best)) best = foot;
  }
  return best;
}

double Middle(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

Oracle Judge(const ContactProblem& p, const Answer& answer) {
  const ContactTable& t = p.contacts;
  const auto bodies = std::ssize(p.mass), contacts = std::ssize(t.gap);
  Oracle o{Matrix::Zero(3 * bodies, 2 * contacts), Vector::Zero(3 * bodies)};
  Vector velocity(3 * bodies), free(3 * bodies), impulse(2 * contacts), mass(3 * bodies);
  double load2 = 0.0, energy = 0.0, scale = p.approach_speed;
  for (Eigen::Index i = 0; i < bodies; ++i) {
    const Twist &v = answer.velocity[i], &f = p.free_velocity[i];
    velocity.segment<3>(3 * i) << v.vx, v.vy, v.spin;
    free.segment<3>(3 * i) << f.vx, f.vy, f.spin;
    mass.segment<3>(3 * i) << p.mass[i], p.mass[i], p.inertia[i];
    if (std::isinf(p.mass[i])) continue;
    o.inverse_mass.segment<3>(3 * i) = mass.segment<3>(3 * i).cwiseInverse();
    const double load = std::hypot(p.impulse[i].fx, p.impulse[i].fy);
    load2 += load * load;
    energy += load * load / p.mass[i];
    scale = std::max(scale, load / p.mass[i]);
  }
  for (Eigen::Index c = 0; c < contacts; ++c) {
    const Vec2 n = t.normal[c], tangent{n.y, -n.x};
    const Vec2 arm_a = t.has_arms() ? t.arm_a[c] : Vec2{}, arm_b = t.has_arms() ? t.arm_b[c] : Vec2{};
    const Vec2 at_a = arm_a + t.lever_a[c] * n, at_b = arm_b - t.lever_b[c] * n;  // from the centres of mass
    for (int k = 0; k < 2; ++k) {
      const Vec2 unit = k == 0 ? n : tangent;
      // The normal impulse has no moment about the centre of a disk: the lever is along it.
      o.transfer.block<3, 1>(3 * t.a[c], 2 * c + k) << -unit.x, -unit.y, -Cross(at_a, unit);
      o.transfer.block<3, 1>(3 * t.b[c], 2 * c + k) << unit.x, unit.y, Cross(at_b, unit);
    }
    impulse.segment<2>(2 * c) << answer.impulse[c].x, answer.impulse[c].y;
    scale = std::max(scale, -p.offset[c]);
  }
  const Vector v = o.transfer.transpose() * velocity;
  const Matrix w = o.transfer.transpose() * o.inverse_mass.asDiagonal() * o.transfer;
  double e2 = 0.0, worst = 0.0;
  for (Eigen::Index c = 0; c < contacts; ++c) {
    const double mu = t.friction[c], wnn = w(2 * c, 2 * c), wtt = w(2 * c + 1, 2 * c + 1);
    const double un = v(2 * c) + p.offset[c], ut = v(2 * c + 1), rn = impulse(2 * c), rt = impulse(2 * c + 1);
    const double rho = 1.0 / (mu > 0.0 ? std::max(wnn, wtt) : wnn);
    const Vec2 moved = mu > 0.0 ? Vec2{rn - rho * (un + mu * std::abs(ut)), rt - rho * ut} : Vec2{rn - rho * un, 0.0};
    const Vec2 e = Vec2{rn, rt} - Nearest(moved, mu);
    e2 += Dot(e, e);
    const double bound = wtt * mu * std::max(rn, 0.0);
    worst = std::max({worst, std::abs(std::min(un, wnn * rn)), std::abs(wtt * rt - Middle(-bound, wtt * rt - ut, bound))});
    if (mu == 0.0) worst = std::max(worst, std::abs(wtt * rt));
  }
  o.nat = std::sqrt(e2) / std::max(impulse.norm(), 1e-3 * std::sqrt(load2));
  o.nat_max = worst / scale;
  const Vector balance = velocity - free - o.inverse_mass.asDiagonal() * o.transfer * impulse;
  double defect = 0.0;
  for (Eigen::Index k = 0; k < mass.size(); ++k) {
    if (std::isfinite(mass(k))) defect += mass(k) * balance(k) * balance(k);
  }
  o.momentum_defect = std::sqrt(defect / energy);
  return o;
}

/// The lattice of SampleProblem with bodies that are no centred disks, all kinds of offsets and some contacts without friction.
ContactProblem RoughProblem(unsigned seed) {
  ContactProblem p = test::SampleProblem({.columns = 4, .rows = 4});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  p.subdomain.clear();
  p.approach_speed = 0.1 + 0.1 * draw(random);
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    const double angle = std::numbers::pi * draw(random);
    p.contacts.normal[c] = {std::cos(angle), std::sin(angle)};
    p.contacts.lever_a[c] = 1.0 + 0.5 * draw(random);
    p.contacts.lever_b[c] = 1.0 + 0.5 * draw(random);
    p.contacts.arm_a.push_back({draw(random), draw(random)});
    p.contacts.arm_b.push_back({draw(random), draw(random)});
    p.contacts.friction[c] = c % 5 == 0 ? 0.0 : 0.5 + 0.5 * draw(random);
    p.offset[c] = 0.1 * draw(random);
  }
  return p;
}

TEST(Oracle, AgreesOnAnyAnswer) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ContactProblem p = RoughProblem(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> draw;
    Answer answer{p.free_velocity, std::vector<Vec2>(p.contacts.size())};
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      if (!std::isinf(p.mass[i])) answer.velocity[i] = {draw(random), draw(random), draw(random)};
    }
    for (Vec2& r : answer.impulse) r = {draw(random), draw(random)};
    const Oracle oracle = Judge(p, answer);
    const AnswerResiduals measured = MeasureAnswer(p, answer);
    EXPECT_NEAR(measured.nat, oracle.nat, 1e-12 * oracle.nat) << seed;
    EXPECT_NEAR(measured.nat_max, oracle.nat_max, 1e-12 * oracle.nat_max) << seed;
    EXPECT_NEAR(measured.momentum_defect, oracle.momentum_defect, 1e-12 * oracle.momentum_defect) << seed;
  }
}

TEST(Oracle, AgreesWithWhatSolversReport) {
  for (const double friction : {0.3, 0.0}) {
    for (const int sweeps : {1, 7, 50}) {
      const ContactProblem p = test::SampleProblem({.friction = friction, .subdomains = 3});
      NscddOptions options;
      options.stopping.tolerance = 0.0;
      options.stopping.max_iterations = options.stopping.test_every = sweeps;
      const ContactSolution solution = SolveContactProblem(p, options);
      const Oracle oracle = Judge(p, {solution.velocity, solution.impulse});
      // Copies of a body agree to rounding only.
      EXPECT_NEAR(solution.report.residuals.nat, oracle.nat, 1e-9 * oracle.nat) << friction << " " << sweeps;
      EXPECT_NEAR(solution.report.residuals.nat_max, oracle.nat_max, 1e-9 * oracle.nat_max) << friction << " " << sweeps;
      EXPECT_LT(oracle.momentum_defect, 1e-12);
    }
  }
}

Matrix Dense(const SparseMatrix& s) {
  Matrix m = Matrix::Zero(s.rows, s.columns());
  for (std::int32_t column = 0; column < s.columns(); ++column) {
    for (std::int32_t k = s.start[column]; k < s.start[column + 1]; ++k) m(s.row[k], column) = s.value[k];
  }
  return m;
}

TEST(Oracle, AgreesOnTheOperators) {
  const ContactProblem p = RoughProblem(3);
  const Oracle oracle = Judge(p, {p.free_velocity, std::vector<Vec2>(p.contacts.size())});
  const ContactOperators o = MakeContactOperators(p);
  const Matrix delassus = oracle.transfer.transpose() * oracle.inverse_mass.asDiagonal() * oracle.transfer;
  EXPECT_LT((Dense(o.delassus) - delassus).norm(), 1e-12 * delassus.norm());
  const Matrix h = Dense(o.transfer);  // the only prescribed body is the last one
  EXPECT_LT((h - oracle.transfer.topRows(h.rows())).norm(), 1e-12 * h.norm());
  const Vector f = Eigen::Map<const Vector>(o.momentum.data(), std::ssize(o.momentum));
  const Vector w = Eigen::Map<const Vector>(o.offset.data(), std::ssize(o.offset));
  const Vector q = Eigen::Map<const Vector>(o.free_velocity.data(), std::ssize(o.free_velocity));
  EXPECT_LT((h.transpose() * Dense(o.mass).inverse() * f + w - q).norm(), 1e-12 * q.norm());
}

}  // namespace
}  // namespace nscdd
