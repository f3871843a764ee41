// SPDX-License-Identifier: Apache-2.0
// Identities of the decomposition (math: section 5 of Visseq, Alart and Dureisseix's method) on a dense random sample.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algorithms/algorithms.h"
#include "nlgs/sweep.h"
#include "nscdd/contact_problem.h"
#include "problem/state.h"
#include "problem/subdomain_builder.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Sample;
using test::SampleProblem;

class Identities : public testing::TestWithParam<int> {
 protected:
  const int subdomains_ = GetParam();
};

// (a) interface impulses sum to zero per body; (b) the mean of the copies is V_f + M^-1 sum H_E r_E, for the impulses of any
// iteration.
TEST_P(Identities, MeanOfCopiesIsTheGlobalVelocity) {
  const ContactProblem global = SampleProblem({.subdomains = subdomains_});
  Sample sample(global);
  NscddOptions o;
  o.stopping.max_iterations = 7;
  o.stopping.tolerance = 1e-300;
  SerialCommunicator serial;
  PartitionedState state = InitialState(sample.problem, {});
  InterfaceWorkspace workspace;
  Solve(sample.problem, o, &serial, &workspace, &state);
  for (std::size_t e = 0; e < sample.problem.subdomains.size(); ++e) {
    Sweep(sample.problem.subdomains[e], &state.subdomains[e]);  // the copies disagree again
  }

  std::vector<double> f(3 * global.mass.size()), mean(3 * global.mass.size());
  std::vector<double> count(global.mass.size());
  for (std::size_t k = 0; k < sample.problem.interface.copies.size(); ++k) {
    const auto& copy = sample.problem.interface.copies[k];
    const std::int32_t row = sample.problem.subdomains[copy.problem].body[copy.body];
    for (int d = 0; d < 3; ++d) f[3 * row + d] += state.interface.impulse[3 * k + d];
  }
  for (const double sum : f) EXPECT_NEAR(sum, 0.0, 1e-13);

  for (std::size_t e = 0; e < sample.problem.subdomains.size(); ++e) {
    const SubdomainProblem& p = sample.problem.subdomains[e];
    for (std::size_t b = 0; b < p.body_count(); ++b) {
      count[p.body[b]] += 1.0;
      for (int d = 0; d < 3; ++d) mean[3 * p.body[b] + d] += state.subdomains[e].velocity[3 * b + d];
    }
  }
  const std::vector<Twist> expected = sample.GlobalVelocity(state);
  int interface_bodies = 0;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] == 0.0 || std::isinf(global.mass[i])) continue;
    interface_bodies += count[i] > 1.0;
    EXPECT_NEAR(mean[3 * i] / count[i], expected[i].vx, 1e-13) << "body " << i;
    EXPECT_NEAR(mean[3 * i + 1] / count[i], expected[i].vy, 1e-13) << "body " << i;
    EXPECT_NEAR(mean[3 * i + 2] / count[i], expected[i].spin, 1e-13) << "body " << i;
  }
  EXPECT_EQ(interface_bodies > 0, subdomains_ > 1);
}

// (c) one subdomain is NSCD bit for bit; (d) the limit is NSCD's: the same residual of the same global problem.
TEST_P(Identities, LimitIsThatOfTheGlobalProblem) {
  const ContactProblem global = SampleProblem({.friction = 0.0, .subdomains = subdomains_});
  ContactProblem whole = global;
  whole.subdomain.clear();
  NscdOptions nscd;
  nscd.stopping.tolerance = 1e-12;
  nscd.stopping.max_iterations = 1000000;
  NscddOptions nscdd;
  nscdd.stopping = nscd.stopping;
  const ContactSolution one = SolveContactProblem(whole, nscd), parts = SolveContactProblem(global, nscdd);
  ASSERT_EQ(one.report.status, SolveStatus::kConverged) << one.report.reason;
  ASSERT_EQ(parts.report.status, SolveStatus::kConverged) << parts.report.reason;
  for (std::size_t i = 0; i < one.velocity.size(); ++i) {
    const double tolerance = subdomains_ == 1 ? 0.0 : 1e-9;
    EXPECT_NEAR(one.velocity[i].vx, parts.velocity[i].vx, tolerance);
    EXPECT_NEAR(one.velocity[i].vy, parts.velocity[i].vy, tolerance);
    EXPECT_NEAR(one.velocity[i].spin, parts.velocity[i].spin, tolerance);
  }
}

// Momentum of the sample changes by the loads and by what the walls give, whatever the iterate.
TEST_P(Identities, MomentumIsConservedAtEveryIterate) {
  const ContactProblem global = SampleProblem({.subdomains = subdomains_});
  NscddOptions o;
  o.stopping.max_iterations = 3;
  o.stopping.tolerance = 1e-300;
  const ContactSolution s = SolveContactProblem(global, o);
  double px = 0.0, py = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < global.mass.size(); ++i) {
    if (std::isinf(global.mass[i])) continue;
    px += global.mass[i] * (s.velocity[i].vx - global.free_velocity[i].vx);
    py += global.mass[i] * (s.velocity[i].vy - global.free_velocity[i].vy);
  }
  for (std::size_t c = 0; c < global.contacts.size(); ++c) {
    const Vec2 n = global.contacts.normal[c], t{n.y, -n.x};
    const Vec2 on_b = s.impulse[c].x * n + s.impulse[c].y * t;
    scale += Norm(on_b);
    if (std::isinf(global.mass[global.contacts.a[c]])) {
      px -= on_b.x;
      py -= on_b.y;
    } else if (std::isinf(global.mass[global.contacts.b[c]])) {
      px += on_b.x;
      py += on_b.y;
    }
  }
  EXPECT_GT(scale, 1.0);
  EXPECT_NEAR(px, 0.0, 1e-14 * scale);
  EXPECT_NEAR(py, 0.0, 1e-14 * scale);
}

INSTANTIATE_TEST_SUITE_P(Subdomains, Identities, testing::Values(1, 2, 3, 6, 40));

// Multiplicities 1 to 6: one disk with six neighbours, each contact in a subdomain of its own.
TEST(Multiplicity, OneToSix) {
  for (int m = 1; m <= 6; ++m) {
    const ContactProblem p = test::FlowerProblem(m);
    NscddOptions o;
    o.stopping.tolerance = 1e-13;
    o.stopping.max_iterations = 100000;
    const ContactSolution parts = SolveContactProblem(p, o);
    ContactProblem whole = p;
    whole.subdomain.clear();
    NscdOptions nscd;
    nscd.stopping = o.stopping;
    const ContactSolution one = SolveContactProblem(whole, nscd);
    EXPECT_EQ(parts.report.max_multiplicity, m);
    EXPECT_EQ(parts.report.status, SolveStatus::kConverged);
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      EXPECT_NEAR(one.velocity[i].vx, parts.velocity[i].vx, 1e-11) << "multiplicity " << m << " body " << i;
      EXPECT_NEAR(one.velocity[i].vy, parts.velocity[i].vy, 1e-11) << "multiplicity " << m << " body " << i;
    }
  }
}

}  // namespace
}  // namespace nscdd
