// SPDX-License-Identifier: Apache-2.0
// The share of impulses that no velocity sees, in problems whose self-stresses are known, and against a dense projection.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "nscdd/contact_kinematics.h"
#include "nscdd/self_stress.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::FlowerProblem;
using test::SampleProblem;

// P from the null space of H, column by column.
double Dense(const ContactProblem& p, const std::vector<Vec2>& impulse) {
  const auto contacts = static_cast<Eigen::Index>(p.contacts.size()), bodies = static_cast<Eigen::Index>(p.mass.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * bodies, 2 * contacts);
  Eigen::VectorXd x(2 * contacts);
  for (Eigen::Index c = 0; c < contacts; ++c) {
    const ContactKinematics h = KinematicsOf(p.contacts, c);
    const auto inverse = [&](std::int32_t i) {
      return std::isinf(p.mass[i]) ? InverseMass{} : InverseMass{1.0 / p.mass[i], 1.0 / p.inertia[i]};
    };
    const Delassus w = DelassusOf(h, inverse(p.contacts.a[c]), inverse(p.contacts.b[c]));
    x(2 * c) = std::sqrt(w.nn) * impulse[c].x;
    x(2 * c + 1) = p.contacts.friction[c] > 0.0 ? std::sqrt(w.tt) * impulse[c].y : 0.0;
    for (int d = 0; d < 2; ++d) {
      if (d == 1 && p.contacts.friction[c] == 0.0) continue;
      std::vector<Wrench> push(bodies);
      AddImpulse(h, d == 0 ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0}, &push[p.contacts.a[c]], &push[p.contacts.b[c]]);
      for (Eigen::Index i = 0; i < bodies; ++i) {
        if (std::isinf(p.mass[i])) continue;
        a.block(3 * i, 2 * c + d, 3, 1) =
            Eigen::Vector3d(push[i].fx, push[i].fy, push[i].torque) / std::sqrt(d == 0 ? w.nn : w.tt);
      }
    }
  }
  const Eigen::VectorXd y = a.transpose().completeOrthogonalDecomposition().solve(x);
  return (x - a.transpose() * y).norm() / x.norm();
}

TEST(SelfStress, OfADiskBetweenPrescribedOnes) {
  ContactProblem p = FlowerProblem(4);  // the first and the last petal are opposite
  for (std::size_t i = 1; i < p.mass.size(); ++i) p.mass[i] = p.inertia[i] = INFINITY;
  for (double& mu : p.contacts.friction) mu = 0.0;
  const auto share = [&](double first, double last) {
    return UndeterminedShare(p, {{first, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {last, 0.0}});
  };
  EXPECT_NEAR(share(1.0, 1.0), 1.0, 1e-12);
  EXPECT_NEAR(share(3.0, 1.0), std::sqrt(0.8), 1e-12);  // 2 and 2 of 3 and 1
  EXPECT_NEAR(share(1.0, 0.0), 0.0, 1e-12);             // an open contact bears none
  EXPECT_EQ(share(0.0, 0.0), 0.0);
}

TEST(SelfStress, IsTheProjectionOnTheNullSpace) {
  for (const double friction : {0.0, 0.3}) {
    const ContactProblem p = SampleProblem({.columns = 5, .rows = 4, .friction = friction});
    std::vector<Vec2> impulse;
    for (std::size_t c = 0; c < p.contacts.size(); ++c) {
      impulse.push_back({1.0 + std::sin(3.0 * c), friction == 0.0 ? 0.0 : 0.2 * std::cos(5.0 * c)});
    }
    const double share = Dense(p, impulse);
    EXPECT_GT(share, 0.1);
    EXPECT_NEAR(UndeterminedShare(p, impulse), share, 1e-8);
  }
}

}  // namespace
}  // namespace nscdd
