// SPDX-License-Identifier: Apache-2.0
// Anderson acceleration: the same fixed point in fewer iterations, on swept states, with its safeguards.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/algorithms.h"
#include "algorithms/anderson.h"
#include "nlgs/residual.h"
#include "nlgs/sweep.h"
#include "nscdd/contact_problem.h"
#include "nscdd/error.h"
#include "problem/state.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Sample;
using test::SampleProblem;

constexpr AccelerationOptions kPlain{Acceleration::kNone};

StoppingOptions To(double tolerance) { return {.tolerance = tolerance, .max_iterations = 2000000, .test_every = 1}; }

/// `count` disks of mass 1 on a prescribed floor, the top one `top` times as heavy, under gravity during 0.01 s.
ContactProblem Column(int count, double top) {
  ContactProblem p;
  const double dv = -9.81 * 0.01;
  for (int i = 0; i <= count; ++i) {
    const double mass = i == 0 ? INFINITY : i == count ? top : 1.0;
    p.mass.push_back(mass);
    p.inertia.push_back(i == 0 ? INFINITY : 0.5 * mass);
    p.free_velocity.push_back(i == 0 ? Twist{} : Twist{0.0, dv, 0.0});
    p.impulse.push_back(i == 0 ? Wrench{} : Wrench{0.0, mass * dv, 0.0});
    if (i == 0) continue;
    ContactTable& t = p.contacts;
    t.a.push_back(i - 1);
    t.b.push_back(i);
    t.normal.push_back({0.0, 1.0});
    t.gap.push_back(0.0);
    t.lever_a.push_back(1.0);
    t.lever_b.push_back(1.0);
    t.friction.push_back(0.3);
    p.offset.push_back(0.0);
  }
  return p;
}

double LargestDifference(const ContactSolution& a, const ContactSolution& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.velocity.size(); ++i) {
    const Twist &x = a.velocity[i], &y = b.velocity[i];
    largest = std::max({largest, std::abs(x.vx - y.vx), std::abs(x.vy - y.vy), std::abs(x.spin - y.spin)});
  }
  return largest;
}

struct Setting {
  int subdomains, depth, every;
};

class Accelerated : public testing::TestWithParam<Setting> {};

// Without friction the velocities are unique, so the accelerated iteration must end at the same ones.
TEST_P(Accelerated, ReachesTheVelocitiesOfThePlainIterationInAFifthOfItsIterations) {
  const Setting& s = GetParam();
  const ContactProblem p = SampleProblem({.friction = 0.0, .subdomains = s.subdomains});
  const ContactSolution plain = SolveContactProblem(p, NscddOptions{To(1e-11), {}, 1, kPlain});
  const ContactSolution fast =
      SolveContactProblem(p, NscddOptions{To(1e-11), {}, 1, {Acceleration::kAnderson, s.depth, s.every}});
  ASSERT_EQ(plain.report.status, SolveStatus::kConverged);
  EXPECT_EQ(fast.report.status, SolveStatus::kConverged) << fast.report.reason;
  EXPECT_LT(LargestDifference(plain, fast), 1e-8);
  EXPECT_LT(5 * fast.report.iterations, plain.report.iterations);
  EXPECT_GT(fast.report.extrapolations, 0);
  EXPECT_LE(s.every * fast.report.extrapolations, fast.report.iterations);
  EXPECT_EQ(plain.report.extrapolations, 0);
  EXPECT_EQ(plain.report.acceleration_restarts, 0);
}

INSTANTIATE_TEST_SUITE_P(Settings, Accelerated,
                         testing::Values(Setting{1, 5, 1}, Setting{1, 2, 1}, Setting{1, 8, 4}, Setting{4, 5, 1},
                                         Setting{13, 5, 2}));

TEST(Acceleration, SolvesColumnsAndHeavyTops) {
  for (const auto& [count, top] : {std::pair{40, 1.0}, std::pair{160, 1.0}, std::pair{5, 1e6}}) {
    const ContactSolution s = SolveContactProblem(Column(count, top), NscdOptions{To(1e-8), {}});
    EXPECT_EQ(s.report.status, SolveStatus::kConverged);
    EXPECT_LT(s.report.iterations, 5 * count + 20) << count << " disks, top " << top;
    EXPECT_NEAR(s.impulse[0].x / (9.81 * 0.01 * (count - 1 + top)), 1.0, 1e-3);
  }
  const ContactSolution plain = SolveContactProblem(Column(40, 1.0), NscdOptions{To(1e-6), kPlain});
  EXPECT_GT(plain.report.iterations, 3000);
}

// What an extrapolation leaves to the next sweep obeys the law of friction, also where impulses vanish or slide.
TEST(Acceleration, ExtrapolatesInsideTheCones) {
  const ContactProblem p = SampleProblem({.friction = 0.6});
  const Sample sample(p);
  SerialCommunicator serial;
  PartitionedState state = InitialState(sample.problem, {});
  const Gluing gluing(sample.problem.subdomains, sample.problem.interface, &serial);
  Anderson anderson(sample.problem, {}, &gluing, &serial, state);
  for (int k = 1; k <= 40; ++k) {
    Sweep(sample.problem.subdomains.front(), &state.subdomains.front());
    anderson.Extrapolate(k, &state);
    const std::vector<double>& r = state.subdomains.front().impulse;
    for (std::size_t i = 0; i < r.size(); i += 2) {
      ASSERT_GE(r[i], 0.0) << "iteration " << k;
      ASSERT_LE(std::abs(r[i + 1]), 0.6 * r[i]) << "iteration " << k;
    }
  }
  EXPECT_GT(anderson.Close({}).extrapolations, 20);
}

// With friction the safeguard has work to do, and the state is a swept one: the cone holds exactly, the residual is that of the
// report and V = V_f + M^-1 H r.
TEST(Acceleration, ReturnsASweptState) {
  const ContactProblem p = SampleProblem({.friction = 0.6, .subdomains = 4});
  Sample sample(p);
  SerialCommunicator serial;
  InterfaceWorkspace workspace;
  PartitionedState state = InitialState(sample.problem, {});
  const SolveReport report = Solve(sample.problem, NscddOptions{To(1e-6), {}, 1, {}}, &serial, &workspace, &state);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_GT(report.acceleration_restarts, 0);
  const std::vector<Twist> expected = sample.GlobalVelocity(state);
  NaturalParts sum;
  for (std::size_t e = 0; e < state.subdomains.size(); ++e) {
    const SubdomainProblem& part = sample.problem.subdomains[e];
    const SubdomainState& s = state.subdomains[e];
    for (std::size_t b = 0; b < part.body_count(); ++b) {
      EXPECT_NEAR(s.velocity[3 * b], expected[part.body[b]].vx, 1e-12);
      EXPECT_NEAR(s.velocity[3 * b + 2], expected[part.body[b]].spin, 1e-12);
    }
    for (std::size_t c = 0; c < part.contact_count(); ++c) {
      EXPECT_GE(s.impulse[2 * c], 0.0);
      EXPECT_LE(std::abs(s.impulse[2 * c + 1]), 0.6 * s.impulse[2 * c]);
    }
    const NaturalParts n = NaturalResidual(part, s);
    sum.sum_e2 += n.sum_e2;
    sum.sum_r2 += n.sum_r2;
  }
  EXPECT_NEAR(Nat(sum.sum_e2, sum.sum_r2, sample.problem.scales), report.residuals.nat, 1e-15);
}

// The accelerated residual rises at times; whatever the budget, what is returned is the best state that was tested.
TEST(Acceleration, ReturnsTheBestTestedState) {
  const ContactProblem p = SampleProblem({.columns = 12, .rows = 12, .friction = 0.8});
  for (int budget = 40; budget <= 120; ++budget) {
    StoppingOptions stopping = To(0.0);
    stopping.max_iterations = budget;
    const ContactSolution s = SolveContactProblem(p, NscdOptions{stopping, {}});
    double best = INFINITY;
    for (const IterationRecord& record : s.report.history) best = std::min(best, record.nat);
    EXPECT_EQ(s.report.residuals.nat, best) << budget;
    EXPECT_EQ(s.report.iterations, budget);
  }
}

// One sweep a stage cannot undo what a large lambda does without friction. By default every lambda converges all the same,
// mostly by the restarts of the acceleration; the next test is the one that needs the guard.
TEST(JumpGuard, LetsEveryLambdaConverge) {
  const ContactProblem p = SampleProblem({.friction = 0.0, .subdomains = 6});
  const ContactSolution nscdd = SolveContactProblem(p, NscddOptions{To(1e-9), {}, 1, {}});
  for (const double lambda : {1.0, 1e2, 1e4, 1e6, 1e8}) {
    FeaOptions o{To(1e-9), {}, 1, {}, {}, true};
    o.stopping.max_iterations = 3000;
    o.interface.lambda = lambda;
    const ContactSolution s = SolveContactProblem(p, o);
    EXPECT_EQ(s.report.status, SolveStatus::kConverged) << "lambda " << lambda << ": " << s.report.reason;
    EXPECT_LT(LargestDifference(nscdd, s), 1e-6) << "lambda " << lambda;
  }
}

// With the velocities of now in the search direction the copies drift apart, and only the guard undoes it.
TEST(JumpGuard, IsNeededWithCurrentVelocities) {
  const ContactProblem p = SampleProblem({.columns = 12, .rows = 12, .friction = 0.0, .subdomains = 6});
  for (const bool guarded : {true, false}) {
    FeaOptions o{To(1e-6), {}, 1, {}, {}, guarded};
    o.stopping.test_every = 5;
    o.stopping.max_iterations = 1000;
    o.interface.local_velocity = LocalVelocity::kCurrent;
    o.interface.lambda = 1.0;
    const SolveReport report = SolveContactProblem(p, o).report;
    EXPECT_EQ(report.status == SolveStatus::kConverged, guarded) << report.reason;
  }
}

TEST(Acceleration, RefusesImpossibleOptions) {
  const ContactProblem p = SampleProblem({});
  EXPECT_THROW(SolveContactProblem(p, NscdOptions{{}, {Acceleration::kAnderson, 0, 1}}), Error);
  EXPECT_THROW(SolveContactProblem(p, NscdOptions{{}, {Acceleration::kAnderson, 9, 1}}), Error);
  EXPECT_THROW(SolveContactProblem(p, NscdOptions{{}, {Acceleration::kAnderson, 5, 0}}), Error);
}

}  // namespace
}  // namespace nscdd
