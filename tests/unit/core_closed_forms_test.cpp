// SPDX-License-Identifier: Apache-2.0
// Whole steps against closed forms: rest, slide, roll, flight, impact, the normal laws and the theta scheme.

#include <gtest/gtest.h>

#include <cmath>

#include "host.h"

namespace nscdd {
namespace {

using test::Exact;
using test::Host;

constexpr double kG = 9.81;
constexpr double kDt = 0.01;

/// One disk of radius 0.5 on a floor that is inclined by `angle`: gravity is.
Host OnIncline(double angle, double friction) {
  Host host({}, Exact());
  host.world.gravity = {kG * std::sin(angle), -kG * std::cos(angle)};
  host.AddFloor(0, friction);
  host.AddDisk(1, {0.0, 0.5}, 0.5, friction);
  return host;
}

TEST(ClosedForm, DiskAtRest) {
  Host host = OnIncline(0.0, 0.3);
  const StepReport& report = host.Step(1000, kDt);
  const reference::Body& disk = host.body(1);
  EXPECT_NEAR(disk.pose.x, 0.0, 1e-12);
  EXPECT_NEAR(disk.pose.y, 0.5, 1e-12);
  EXPECT_NEAR(disk.velocity.vy, 0.0, 1e-14);
  EXPECT_EQ(disk.velocity.spin, 0.0);
  ASSERT_EQ(host.stepper().contacts().size(), 1u);
  EXPECT_NEAR(host.stepper().contacts().impulse[0].x, disk.mass * kG * kDt, 1e-10);
  EXPECT_EQ(host.stepper().contacts().status[0], ContactStatus::kSticking);
  EXPECT_EQ(report.step, 1000);
  EXPECT_NEAR(report.time, 10.0, 1e-12);
}

TEST(ClosedForm, Slide) {
  const double angle = 0.5, mu = 0.1;  // 3 mu < tan(angle)
  Host host = OnIncline(angle, mu);
  host.Step(200, kDt);
  const double t = 2.0, a = kG * (std::sin(angle) - mu * std::cos(angle));
  const double spin = -2.0 * mu * kG * std::cos(angle) * t / 0.5;
  const reference::Body& disk = host.body(1);
  EXPECT_NEAR(disk.velocity.vx, a * t, 1e-11);
  EXPECT_NEAR(disk.velocity.spin, spin, 1e-11);
  EXPECT_NEAR(disk.pose.x, 0.5 * a * t * t, 1e-10);
  EXPECT_NEAR(disk.pose.angle, 0.5 * spin * t, 1e-10);
  EXPECT_NEAR(disk.pose.y, 0.5, 1e-12);
  EXPECT_EQ(host.stepper().contacts().status[0], ContactStatus::kSliding);
}

TEST(ClosedForm, Roll) {
  const double angle = 0.4;
  Host host = OnIncline(angle, 0.5);
  host.Step(200, kDt);
  const double t = 2.0, a = 2.0 / 3.0 * kG * std::sin(angle);
  const reference::Body& disk = host.body(1);
  EXPECT_NEAR(disk.velocity.vx, a * t, 1e-10);
  EXPECT_NEAR(disk.velocity.spin, -a * t / 0.5, 1e-10);
  EXPECT_NEAR(disk.pose.x, 0.5 * a * t * t, 1e-10);
  EXPECT_NEAR(disk.pose.angle, -disk.pose.x / 0.5, 1e-10);
}

// y_n = y_0 - g dt^2 (n (n - 1) / 2 + theta n): exact for theta = 1/2, as which the law of two stages flies whatever theta.
TEST(ClosedForm, FlightForAnyTheta) {
  for (const double theta : {0.0, 0.5, 0.75, 1.0}) {
    const bool has_theta = theta > 0.0;
    Host host({.theta = has_theta ? theta : 0.5, .normal_law = has_theta ? NormalLaw::kGap : NormalLaw::kImpact});
    host.world.gravity = {0.0, -kG};
    reference::Body& flying = host.AddDisk(1, {1.0, 2.0}, 0.5);
    flying.velocity = {3.0, 4.0, 5.0};
    flying.force = {0.0, 0.0, 0.25 * flying.inertia};
    const int n = 150;
    const StepReport& report = host.Step(n, kDt);
    const double drift = kDt * kDt * (0.5 * n * (n - 1.0) + (has_theta ? theta : 0.5) * n);
    EXPECT_NEAR(flying.pose.x, 1.0 + 3.0 * n * kDt, 1e-12);
    EXPECT_NEAR(flying.pose.y, 2.0 + 4.0 * n * kDt - kG * drift, 1e-11);
    EXPECT_NEAR(flying.pose.angle, 5.0 * n * kDt + 0.25 * drift, 1e-12);
    EXPECT_NEAR(flying.velocity.vy, 4.0 - kG * n * kDt, 1e-12);
    EXPECT_NEAR(flying.velocity.spin, 5.0 + 0.25 * n * kDt, 1e-12);
    EXPECT_EQ(report.solve.status, SolveStatus::kConverged);
    EXPECT_EQ(report.solve.contacts, 0);
  }
}

// The distance of the two half drifts, or of the displacement, not that of the final velocity.
TEST(ClosedForm, LargestDrift) {
  for (const NormalLaw law : {NormalLaw::kGap, NormalLaw::kImpact}) {
    Host host({.alert_distance = 1.0, .normal_law = law}, Exact());
    host.AddFloor(0);
    reference::Body& falls = host.AddDisk(1, {0.0, 0.505}, 0.5);
    falls.velocity = {0.0, -1.0, 0.0};
    falls.restitution = law == NormalLaw::kImpact ? 1.0 : 0.0;
    host.AddDisk(2, {9.0, 9.0}, 0.5).velocity = {0.03, 0.04, 0.0};
    EXPECT_NEAR(host.Step(kDt).max_drift, 5e-3, 1e-15);  // disk 1 to the floor
    EXPECT_NEAR(falls.pose.y, 0.5, 1e-15);
  }
}

// Without friction a spin is kept to the bit and turns the angle; a torque changes it, whatever the contacts do.
TEST(ClosedForm, FrictionlessDiskKeepsItsSpin) {
  Host host = OnIncline(0.2, 0.0);
  host.body(1).velocity.spin = 0.7;
  host.AddDisk(2, {10.0, 0.5}, 0.5).force.torque = 3.0;
  const StepReport& report = host.Step(100, kDt);
  EXPECT_EQ(report.solve.active, 2);
  EXPECT_EQ(report.solve.unknowns_per_body, 2);
  EXPECT_EQ(host.body(1).velocity.spin, 0.7);
  EXPECT_NEAR(host.body(1).pose.angle, 0.7, 1e-13);
  EXPECT_NEAR(host.body(2).velocity.spin, 3.0 / host.body(2).inertia, 1e-12);
  EXPECT_NEAR(host.body(2).pose.angle, 0.5 * 3.0 / host.body(2).inertia, 1e-12);
}

class Restitution : public testing::TestWithParam<double> {};

TEST_P(Restitution, DiskOnFloor) {
  Host host({.normal_law = NormalLaw::kImpact}, Exact());
  host.world.gravity = {0.0, -kG};  // no part in it: what counts is the approach before the step
  host.AddFloor(0);
  reference::Body& disk = host.AddDisk(1, {0.0, 0.5}, 0.5);
  disk.restitution = GetParam();
  disk.velocity = {0.25, -2.0, 0.0};
  const StepReport& report = host.Step(kDt);
  EXPECT_EQ(report.second_solves, GetParam() > 0.0);
  EXPECT_NEAR(disk.velocity.vy, 2.0 * GetParam(), 1e-14);
  EXPECT_EQ(disk.velocity.vx, 0.25);
}

TEST_P(Restitution, HeadOn) {
  Host host({}, Exact());
  reference::Body& left = host.AddDisk(1, {0.0, 0.0}, 0.5);
  reference::Body& right = host.AddDisk(2, {1.0, 0.0}, 0.5);
  right.mass *= 3.0;
  left.restitution = GetParam();
  left.velocity.vx = 2.0;
  right.velocity.vx = -1.0;
  const double momentum = left.mass * 2.0 - right.mass;
  const StepReport& report = host.Step(kDt);
  EXPECT_NEAR(right.velocity.vx - left.velocity.vx, GetParam() * 3.0, 1e-13);
  EXPECT_NEAR(left.mass * left.velocity.vx + right.mass * right.velocity.vx, momentum, 1e-12 * left.mass);
  EXPECT_NEAR(report.momentum_x, momentum, 1e-12 * left.mass);
}

INSTANTIATE_TEST_SUITE_P(Coefficients, Restitution, testing::Values(0.0, 0.5, 1.0));

// One stage. Open at the detection: the gap closes to (1 - theta) of it and nothing rebounds.
TEST(NormalLaws, OpenContactClosesWithoutRebound) {
  for (const double theta : {0.5, 0.8}) {
    Host host({.theta = theta, .alert_distance = 0.1, .normal_law = NormalLaw::kGap}, Exact());
    host.AddFloor(0);
    reference::Body& disk = host.AddDisk(1, {0.0, 0.52}, 0.5);
    disk.restitution = 1.0;
    disk.velocity.vy = -2.5;
    const double gap = 0.02 - (1.0 - theta) * kDt * 2.5;
    const StepReport& report = host.Step(kDt);
    EXPECT_NEAR(disk.velocity.vy, -gap / kDt, 1e-13);
    EXPECT_NEAR(disk.pose.y - 0.5, (1.0 - theta) * gap, 1e-15);
    EXPECT_NEAR(host.stepper().contacts().gap[0], gap, 1e-15);
    EXPECT_NEAR(host.stepper().contacts().final_gap[0], (1.0 - theta) * gap, 1e-15);
    EXPECT_EQ(report.max_interpenetration, 0.0);
  }
}

TEST(NormalLaws, StrictSeesNoOpenContact) {
  Host host({.alert_distance = 0.1, .normal_law = NormalLaw::kStrict}, Exact());
  host.AddFloor(0);
  reference::Body& disk = host.AddDisk(1, {0.0, 0.5125}, 0.5);
  disk.velocity.vy = -1.0;
  EXPECT_EQ(host.Step(kDt).solve.contacts, 0);  // gap 0.0075 at the detection
  EXPECT_EQ(disk.velocity.vy, -1.0);
  const StepReport& closed = host.Step(kDt);  // -0.0025 there
  EXPECT_EQ(closed.solve.contacts, 1);
  EXPECT_NEAR(disk.velocity.vy, 0.0, 1e-15);
  EXPECT_NEAR(disk.pose.y, 0.4975, 1e-15);
  EXPECT_NEAR(closed.max_interpenetration, 0.0025, 1e-15);
  EXPECT_NEAR(closed.mean_interpenetration, 0.0025, 1e-15);
}

struct Feedback {
  double beta, slop, cap, speed;
};
class GapFeedback : public testing::TestWithParam<Feedback> {};

// Two resting disks that overlap by 0.1.
TEST_P(GapFeedback, OneStep) {
  const Feedback& f = GetParam();
  const SteppingOptions o{
      .normal_law = NormalLaw::kFeedback, .feedback_beta = f.beta, .feedback_slop = f.slop, .feedback_cap = f.cap};
  Host host(o, Exact());
  reference::Body& left = host.AddDisk(1, {0.0, 0.0}, 0.5);
  reference::Body& right = host.AddDisk(2, {0.9, 0.0}, 0.5);
  left.restitution = 1.0;
  const StepReport& report = host.Step(kDt);
  EXPECT_NEAR(right.velocity.vx - left.velocity.vx, f.speed, 1e-13);
  EXPECT_NEAR(right.pose.x - left.pose.x, 0.9 + 0.5 * kDt * f.speed, 1e-14);
  const double impulse = right.mass * right.velocity.vx;
  EXPECT_NEAR(report.injected_energy, impulse * f.speed, 1e-12 * right.mass);
}

INSTANTIATE_TEST_SUITE_P(Options, GapFeedback,
                         testing::Values(Feedback{0.2, 0.0, 1e300, 2.0}, Feedback{0.2, 0.04, 1e300, 1.2},
                                         Feedback{0.2, 0.04, 0.5, 0.5}, Feedback{0.2, 0.1, 1e300, 0.0},
                                         Feedback{0.0, 0.0, 1e300, 0.0}));

TEST(NormalLaws, FeedbackUndoesInterpenetrationDownToTheSlop) {
  for (const double slop : {0.0, 0.01}) {
    Host host({.normal_law = NormalLaw::kFeedback, .feedback_beta = 0.1, .feedback_slop = slop}, Exact());
    host.world.gravity = {0.0, -kG};
    host.AddFloor(0);
    host.AddDisk(1, {0.0, 0.45}, 0.5);
    const StepReport& report = host.Step(400, kDt);
    EXPECT_NEAR(report.max_interpenetration, slop, 1e-12);
    EXPECT_NEAR(host.body(1).velocity.vy, 0.0, 1e-10);
  }
}

// Where nothing loads the bodies, the speeds of recovery are the scale of nat_max: a column is not solved by its first sweep.
TEST(NormalLaws, RecoveryIsAScaleWithoutLoads) {
  NscdOptions nscd = Exact();
  nscd.stopping.criterion = Criterion::kNatMax;
  nscd.stopping.tolerance = 1e-10;
  Host host({.normal_law = NormalLaw::kFeedback, .feedback_beta = 0.1}, nscd);
  host.AddFloor(0);
  for (int i = 0; i < 6; ++i) host.AddDisk(1 + i, {0.0, 0.48 + 0.96 * i}, 0.5);
  const StepReport& report = host.Step(kDt);
  EXPECT_EQ(report.solve.status, SolveStatus::kConverged);
  EXPECT_GT(report.solve.iterations, 1);
  for (int i = 0; i < 6; ++i) {  // 0.02 from the floor, 0.04 from each other
    EXPECT_NEAR(host.body(1 + i).velocity.vy, 0.1 * (0.02 + 0.04 * i) / kDt, 1e-8) << "disk " << i;
  }
}

// Injected energy counts what feedback gives, not what a bounce gives back.
TEST(NormalLaws, ReboundIsNoInjectedEnergy) {
  Host host({.normal_law = NormalLaw::kFeedback}, Exact());
  host.AddFloor(0);
  reference::Body& disk = host.AddDisk(1, {0.0, 0.5}, 0.5);
  disk.restitution = 1.0;
  disk.velocity.vy = -1.0;
  const StepReport& report = host.Step(kDt);
  const double impulse = disk.mass * (1.0 + disk.velocity.vy), feedback = 0.05 * 0.5;  // beta (dt / 2) / dt
  EXPECT_NEAR(disk.velocity.vy, 1.0 + feedback, 1e-13);
  EXPECT_NEAR(report.injected_energy, impulse * feedback, 1e-10);
}

TEST(NormalLaws, NothingIsInjectedWithoutFeedback) {
  for (const NormalLaw law : {NormalLaw::kGap, NormalLaw::kImpact}) {
    Host host({.normal_law = law}, Exact());
    host.AddDisk(1, {0.0, 0.0}, 0.5);
    host.AddDisk(2, {0.9, 0.0}, 0.5);
    const StepReport& report = host.Step(kDt);
    EXPECT_EQ(report.injected_energy, 0.0);
    EXPECT_EQ(report.kinetic_energy, 0.0);
    EXPECT_NEAR(report.max_interpenetration, 0.1, 1e-15);
  }
}

TEST(CoincidentCentres, AreLegal) {
  Host host({.normal_law = NormalLaw::kFeedback}, Exact());
  host.world.gravity = {0.0, -kG};
  host.AddDisk(1, {0.0, 0.0}, 0.5, 0.3);
  host.AddDisk(2, {0.0, 0.0}, 0.5, 0.3);
  const StepReport& report = host.Step(kDt);
  EXPECT_EQ(report.solve.status, SolveStatus::kConverged);
  EXPECT_GT(host.body(2).pose.y, host.body(1).pose.y);
  EXPECT_GT(report.max_interpenetration, 0.9);
}

}  // namespace
}  // namespace nscdd
