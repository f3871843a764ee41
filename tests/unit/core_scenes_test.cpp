// SPDX-License-Identifier: Apache-2.0
// Scenes over many steps: warm start, periodic strips, clusters, worlds without anything to do, scale freedom.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host.h"
#include "packing.h"
#include "problem/state.h"
#include "rows.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Exact;
using test::Host;
using test::Packing;

constexpr double kG = 9.81;
constexpr double kDt = 0.01;

NscddOptions Nscdd(int nx, int ny, double tolerance = 1e-4) {
  NscddOptions o;
  o.stopping.tolerance = tolerance;
  o.stopping.max_iterations = 100000;
  o.partition = {nx, ny, 1};
  return o;
}

Host Column(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, int count = 8) {
  Host host(stepping, algorithm);
  host.world.gravity = {0.0, -kG};
  host.AddFloor(0, 0.3);
  for (int i = 0; i < count; ++i) host.AddDisk(1 + i, {0.0, 0.5 + i}, 0.5, 0.3);
  return host;
}

// A resting column is solved by the impulses of the step before, also when the time step changes: impulses are forces times dt.
TEST(WarmStart, FewIterationsAtRest) {
  NscdOptions nscd = Exact();
  nscd.stopping.tolerance = 1e-9;
  nscd.acceleration.method = Acceleration::kNone;  // it needs few from a cold start, too
  NscddOptions nscdd = Nscdd(1, 3);
  nscdd.stopping = nscd.stopping;
  nscdd.acceleration = nscd.acceleration;
  for (const AlgorithmOptions& algorithm : {AlgorithmOptions(nscd), AlgorithmOptions(nscdd)}) {
    Host warm = Column({}, algorithm), cold = Column({.warm_start = false}, algorithm);
    const int first = warm.Step(kDt).solve.iterations;
    EXPECT_GT(first, 50);
    EXPECT_EQ(cold.Step(kDt).solve.iterations, first);
    EXPECT_LT(4 * warm.Step(kDt).solve.iterations, first);
    EXPECT_GE(cold.Step(kDt).solve.iterations, first / 2);
    EXPECT_LT(4 * warm.Step(2.0 * kDt).solve.iterations, first);
    EXPECT_LT(4 * warm.Step(0.3 * kDt).solve.iterations, first);
    EXPECT_NEAR(warm.body(8).pose.y, 7.5, 1e-9);
  }
}

TEST(WarmStart, ReducesIterationsOnAPile) {
  SerialCommunicator serial;
  SteppingOptions cold;
  cold.warm_start = false;
  const auto iterations = [&](const SteppingOptions& o) {
    int sum = 0;
    const auto outcome = test::Run({.tilt = 0.0}, o, Nscdd(2, 2), 300, &serial);
    for (int k = 280; k < 300; ++k) sum += outcome.reports[k].solve.iterations;
    return sum;
  };
  EXPECT_LT(2 * iterations({}), iterations(cold));
}

// Two disks meet across the ends of the period; momentum is kept, centres stay inside.
TEST(Periodic, ContactsAcrossTheEnds) {
  for (const int nx : {1, 4}) {
    NscddOptions o = Nscdd(nx, 1, 1e-13);
    Host host({}, o);
    host.world.period = 10.0;
    host.world.period_origin = -2.0;
    reference::Body& left = host.AddDisk(1, {-1.5, 0.0}, 0.5);
    reference::Body& right = host.AddDisk(2, {7.2, 0.0}, 0.5);  // 0.3 away from the image at 8.5
    left.velocity.vx = -1.0;
    right.velocity.vx = 2.0;
    bool met = false;
    for (int k = 0; k < 100; ++k) {
      const StepReport& report = host.Step(kDt);
      EXPECT_NEAR(report.momentum_x, left.mass, 1e-10);
      for (const test::ContactRow& c : test::Rows(host.stepper().contacts())) {
        met = met || c.impulse.x > 0.0;
        EXPECT_NE(c.key.image, 0);
        EXPECT_LT(std::abs(c.final_gap), 0.06);  // that of the image
        EXPECT_EQ(std::abs(c.normal.x), 1.0);
      }
      EXPECT_GE(left.pose.x, -2.0);
      EXPECT_LT(left.pose.x, 8.0);
    }
    EXPECT_TRUE(met);
    EXPECT_NEAR(left.velocity.vx, 0.5, 1e-12);
    EXPECT_NEAR(right.velocity.vx, 0.5, 1e-12);
    const double distance = left.pose.x - right.pose.x;
    EXPECT_NEAR(distance - 10.0 * std::floor(distance / 10.0), 1.0, 1e-3);  // modulo the period
  }
}

// A slide through many periods: only the wrapped centre differs from a long floor.
TEST(Periodic, SlideThroughManyPeriods) {
  Host strip({}, Exact()), floor({}, Exact());
  strip.world.period = 4.0;
  for (Host* host : {&strip, &floor}) {
    host->world.gravity = {2.0, -kG};
    host->AddFloor(0, 0.0);
    host->AddDisk(1, {1.0, 0.5}, 0.5, 0.0);
    host->Step(300, kDt);
  }
  EXPECT_GT(floor.body(1).pose.x, 2 * 4.0);
  EXPECT_NEAR(strip.body(1).pose.x, std::fmod(floor.body(1).pose.x, 4.0), 1e-12);
  EXPECT_NEAR(strip.body(1).velocity.vx, floor.body(1).velocity.vx, 1e-12);
}

// Friction that has fallen since the last step: the warm start begins on the new cone.
TEST(WarmStart, BeginsInsideTheCones) {
  const ContactProblem p = test::SampleProblem({.friction = 0.2});
  const test::Sample sample(p);
  const std::vector<Vec2> warm(p.contacts.size(), {1.0, -0.5});
  const std::vector<double> r = InitialState(sample.problem, warm).subdomains.front().impulse;
  for (std::size_t i = 0; i < r.size(); i += 2) {
    EXPECT_EQ(r[i], 1.0);
    EXPECT_EQ(r[i + 1], -0.2);
  }
}

// A dumb-bell that turns hits a floor with one end: that end leaves with e times the speed it came with.
TEST(Clusters, TurningEndRebounds) {
  for (const std::int64_t floor : {0, 2}) {
    Host host({.theta = 1.0, .normal_law = NormalLaw::kGap}, Exact());  // contacts are detected where the bodies are
    host.AddFloor(floor);
    const double angle = -0.1;
    const reference::Disk ends[2] = {{{-1.0, 0.0}, 0.5}, {{1.0, 0.0}, 0.5}};
    reference::Body bell = reference::MakeCluster(1, ends, 1000.0);
    bell.restitution = 0.5;
    bell.pose = {0.0, 0.5 - std::sin(angle) - 1e-6, angle};
    bell.velocity.spin = -1.0;
    host.world.Add(bell);
    host.Step(kDt);
    ASSERT_EQ(host.stepper().contacts().size(), 1u);
    EXPECT_NEAR(host.stepper().contacts().relative_velocity[0].x, 0.5 * std::cos(angle), 1e-12) << "floor " << floor;
  }
}

// A dumb-bell falls on one end (W_nt != 0), then lies on both.
TEST(Clusters, DumbBellComesToRest) {
  for (const double friction : {0.0, 0.4}) {
    NscdOptions nscd = Exact();
    nscd.stopping.tolerance = 1e-11;
    Host host({}, nscd);
    host.world.gravity = {0.0, -kG};
    host.AddFloor(0, friction);
    const reference::Disk ends[2] = {{{-0.8, 1.0}, 0.5}, {{0.8, 1.4}, 0.4}};
    reference::Body bell = reference::MakeCluster(1, ends, 1000.0);
    bell.friction = friction;
    host.world.Add(bell);
    bool coupled = false;
    for (int k = 0; k < 400; ++k) {
      const StepReport& report = host.Step(kDt);
      EXPECT_EQ(report.solve.status, SolveStatus::kConverged);
      EXPECT_LT(report.max_interpenetration, 1e-2);
      if (report.solve.active == 1) coupled = report.solve.unknowns_per_contact == (friction > 0.0 ? 2 : 1);
    }
    EXPECT_TRUE(coupled);
    double weight = 0.0;
    for (const test::ContactRow& c : test::Rows(host.stepper().contacts())) weight += c.impulse.x;
    EXPECT_EQ(host.stepper().contacts().size(), 2u);
    EXPECT_NEAR(weight, bell.mass * kG * kDt, 1e-8 * bell.mass);
    EXPECT_NEAR(host.body(1).velocity.vy, 0.0, 1e-9);
    EXPECT_NEAR(host.body(1).velocity.spin, 0.0, 1e-9);
  }
}

TEST(NothingToDo, EmptyWorld) {
  for (const AlgorithmOptions& algorithm : {AlgorithmOptions(NscdOptions{}), AlgorithmOptions(Nscdd(3, 2))}) {
    Host host({}, algorithm);
    const StepReport& report = host.Step(3, kDt);
    EXPECT_EQ(report.step, 3);
    EXPECT_EQ(report.bodies, 0);
    EXPECT_EQ(report.solve.contacts, 0);
    EXPECT_EQ(report.solve.status, SolveStatus::kConverged);
    EXPECT_EQ(report.solve.empty_subdomains, report.solve.subdomains);
    EXPECT_EQ(report.kinetic_energy, 0.0);
    EXPECT_TRUE(host.stepper().bodies().id.empty());
  }
}

// The default alert distance waits for the first grains.
TEST(NothingToDo, BodiesMayComeLater) {
  Host host({}, Exact());
  host.world.gravity = {0.0, -kG};
  host.AddFloor(0);
  EXPECT_EQ(host.Step(3, kDt).alert_distance, 0.0);
  host.AddDisk(1, {0.0, 1.0}, 0.5);
  EXPECT_NEAR(host.Step(kDt).alert_distance, 0.05, 1e-9);
  host.Step(300, kDt);
  EXPECT_NEAR(host.body(1).pose.y, 0.5, 1e-3);
}

TEST(NothingToDo, AllBodiesFixed) {
  Host host({}, Nscdd(2, 2));
  host.world.gravity = {0.0, -kG};
  host.AddFloor(0, 0.3);
  for (int i = 1; i < 4; ++i) {
    host.AddDisk(i, {0.1 * i, 0.5}, 0.5, 0.3).kind = BodyKind::kPrescribed;
  }
  const StepReport& report = host.Step(5, kDt);
  EXPECT_EQ(report.solve.contacts, 0);
  EXPECT_EQ(report.bodies, 0);
  EXPECT_EQ(host.body(2).pose.y, 0.5);
  EXPECT_EQ(host.stepper().bodies().size(), 4u);
}

struct Scale {
  double length, mass, time;
};

/// Five steps of a packing in other units. Powers of two change no digit.
std::vector<StepReport> RunScaled(const Packing& packing, SteppingOptions stepping, const Scale& s) {
  reference::World world;
  const double g = kG * s.length / (s.time * s.time);
  world.gravity = {g * std::sin(packing.tilt), -g * std::cos(packing.tilt)};
  for (reference::Body body : test::MakeBodies(packing)) {
    body.mass *= s.mass;
    body.inertia *= s.mass * s.length * s.length;
    body.pose = {body.pose.x * s.length, body.pose.y * s.length, body.pose.angle};
    const double speed = s.length / s.time;
    body.velocity = {body.velocity.vx * speed, body.velocity.vy * speed, body.velocity.spin / s.time};
    for (reference::Disk& d : body.disks) d = {s.length * d.centre, s.length * d.radius};
    for (reference::Segment& w : body.segments) w = {s.length * w.a, s.length * w.b};
    world.Add(body);
  }
  stepping.feedback_slop *= s.length;
  reference::ReferenceAdapter adapter(&world);
  SerialCommunicator serial;
  TimeStepper stepper(stepping, Nscdd(2, 2), &adapter, &serial);
  std::vector<StepReport> reports;
  for (int k = 0; k < 5; ++k) reports.push_back(stepper.Step(kDt * s.time));
  return reports;
}

TEST(ScaleFree, UnitsChangeNoIteration) {
  const SteppingOptions feedback{.normal_law = NormalLaw::kFeedback, .feedback_slop = 0.001};
  for (const Packing& packing : {Packing{}, Packing{.friction = 0.0, .restitution = 0.25}, Packing{.clusters = true}}) {
    const std::vector<StepReport> expected = RunScaled(packing, feedback, {1, 1, 1});
    for (const Scale& s : {Scale{0x1p-20, 1, 1}, Scale{1, 0x1p-60, 1}, Scale{1, 1, 0x1p-20}, Scale{0x1p10, 0x1p40, 0x1p6}}) {
      const std::vector<StepReport> scaled = RunScaled(packing, feedback, s);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const Residuals &a = expected[k].solve.residuals, &b = scaled[k].solve.residuals;
        EXPECT_EQ(expected[k].solve.iterations, scaled[k].solve.iterations);
        EXPECT_EQ(expected[k].solve.contacts, scaled[k].solve.contacts);
        EXPECT_EQ(expected[k].solve.active, scaled[k].solve.active);
        EXPECT_EQ(a.nat, b.nat);
        EXPECT_EQ(a.nat_max, b.nat_max);
        EXPECT_EQ(a.qm16, b.qm16);
        EXPECT_EQ(a.relative_jump, b.relative_jump);
        EXPECT_EQ(s.length / s.time * a.interface_jump, b.interface_jump);
        EXPECT_EQ(s.length * expected[k].mean_interpenetration, scaled[k].mean_interpenetration);
        EXPECT_EQ(s.mass * s.length * s.length / (s.time * s.time) * expected[k].injected_energy, scaled[k].injected_energy);
      }
    }
  }
}

}  // namespace
}  // namespace nscdd
