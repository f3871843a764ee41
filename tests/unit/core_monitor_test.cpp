// SPDX-License-Identifier: Apache-2.0
// How a solve ends: each status reached on purpose, with its reason, at the tests that were asked for.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algorithms/monitor.h"
#include "nscdd/contact_problem.h"
#include "nscdd/error.h"
#include "parallel/ordered_reduction.h"
#include "problem/state.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Sample;
using test::SampleProblem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

NscdOptions Options(double tolerance, int max_iterations, int test_every = 5) {
  NscdOptions o;
  o.stopping.tolerance = tolerance;
  o.stopping.max_iterations = max_iterations;
  o.stopping.test_every = test_every;
  return o;
}

void ExpectReason(const SolveReport& report, const std::string& part) {
  EXPECT_NE(report.reason.find(part), std::string::npos) << report.reason;
}

class EveryCriterion : public testing::TestWithParam<Criterion> {};

TEST_P(EveryCriterion, Converges) {
  NscdOptions o = Options(1e-5, 100000);
  o.stopping.criterion = GetParam();
  const ContactSolution s = SolveContactProblem(SampleProblem({}), o);
  EXPECT_EQ(s.report.status, SolveStatus::kConverged);
  ExpectReason(s.report, "is below the tolerance 1e-05");
  EXPECT_LE(Measure(GetParam(), s.report.residuals), 1e-5);
  ASSERT_GE(s.report.history.size(), 2u);
  EXPECT_GT(s.report.iterations, 5);
}

INSTANTIATE_TEST_SUITE_P(All, EveryCriterion,
                         testing::Values(Criterion::kNat, Criterion::kNatMax, Criterion::kQuad, Criterion::kMaxm,
                                         Criterion::kQm16));

TEST(Status, IterationLimit) {
  const ContactSolution s = SolveContactProblem(SampleProblem({}), Options(1e-9, 13));
  EXPECT_EQ(s.report.status, SolveStatus::kIterationLimit);
  EXPECT_EQ(s.report.iterations, 13);
  ExpectReason(s.report, "after 13 iterations, tolerance 1e-09");
}

// Without a tolerance the number of iterations is what was asked for, whatever the residual did on the way.
TEST(Status, Fixed) {
  NscdOptions o = Options(0.0, 40);
  o.stopping.stall_iterations = 1;
  for (const Acceleration method : {Acceleration::kNone, Acceleration::kAnderson}) {
    o.acceleration.method = method;
    const ContactSolution s = SolveContactProblem(SampleProblem({}), o);
    EXPECT_EQ(s.report.status, SolveStatus::kFixed);
    EXPECT_TRUE(IsAsAsked(s.report.status));
    EXPECT_EQ(s.report.iterations, 40);
    ExpectReason(s.report, "after 40 iterations, as many as asked for");
  }
}

// Rounding is a floor that a residual cannot fall through.
TEST(Status, Stalled) {
  NscdOptions o = Options(1e-30, 1000000, 10);
  o.stopping.stall_iterations = 300;
  const ContactSolution s = SolveContactProblem(SampleProblem({}), o);
  EXPECT_EQ(s.report.status, SolveStatus::kStalled) << s.report.reason;
  ExpectReason(s.report, "for 300 iterations");
  EXPECT_LT(s.report.residuals.nat, 1e-12);
  EXPECT_LT(s.report.iterations, 100000);
}

// A first test is always a new minimum, however rare the tests.
TEST(Status, DoesNotStallAtTheFirstTest) {
  NscdOptions o = Options(1e-6, 100000, 20);
  o.stopping.stall_iterations = 20;
  EXPECT_EQ(SolveContactProblem(SampleProblem({}), o).report.status, SolveStatus::kConverged);
}

TEST(Status, WithoutContacts) {
  ContactProblem p = SampleProblem({});
  p.contacts = {};
  p.offset.clear();
  p.subdomain.clear();
  const ContactSolution s = SolveContactProblem(p, Options(1e-6, 10));
  EXPECT_EQ(s.report.status, SolveStatus::kConverged);
  EXPECT_EQ(s.report.iterations, 0);
  EXPECT_EQ(s.report.reason, "no contact");
  EXPECT_EQ(s.velocity.front().vy, p.free_velocity.front().vy);
}

struct Watched {
  explicit Watched(const ContactProblem& p) : source(p), sample(source), state(InitialState(sample.problem, {})) {}
  ContactProblem source;
  Sample sample;
  PartitionedState state;
  SerialCommunicator serial;
  std::vector<SweepStatistics> statistics = std::vector<SweepStatistics>(1);
};

TEST(Status, DivergedByGrowth) {
  Watched w(SampleProblem({}));
  StoppingOptions o;
  o.criterion = Criterion::kNatMax;
  Monitor monitor(w.sample.problem, o, &w.serial);
  ASSERT_FALSE(monitor.Stops(5, w.statistics, {}, w.state));
  for (double& v : w.state.subdomains.front().velocity) v *= 0.9e6;
  ASSERT_FALSE(monitor.Stops(10, w.statistics, {}, w.state));
  for (double& v : w.state.subdomains.front().velocity) v *= 2.0;
  ASSERT_TRUE(monitor.Stops(15, w.statistics, {}, w.state));
  const SolveReport report = monitor.Finish(15, 15, &w.state);
  EXPECT_EQ(report.status, SolveStatus::kDiverged);
  ExpectReason(report, "at the first test");
  for (const double r : w.state.subdomains.front().impulse) EXPECT_EQ(r, 0.0);
  EXPECT_EQ(w.state.subdomains.front().velocity, w.sample.problem.subdomains.front().free_velocity);
  EXPECT_EQ(report.active, 0);
}

// nat is relative to the impulses: where they run away it does not.
TEST(Status, DivergedByNatMaxWhateverTheCriterion) {
  Watched w(SampleProblem({}));
  Monitor monitor(w.sample.problem, {}, &w.serial);
  ASSERT_FALSE(monitor.Stops(5, w.statistics, {}, w.state));
  for (double& r : w.state.subdomains.front().impulse) r = 1e9;
  for (double& v : w.state.subdomains.front().velocity) v *= 1e9;
  ASSERT_TRUE(monitor.Stops(10, w.statistics, {}, w.state));
  const SolveReport report = monitor.Finish(10, 10, &w.state);
  EXPECT_EQ(report.status, SolveStatus::kDiverged);
  ExpectReason(report, "nat_max is");
}

TEST(Status, DivergedByNotANumber) {
  Watched w(SampleProblem({}));
  const std::size_t contact = w.source.contacts.size() / 2;
  Monitor monitor(w.sample.problem, {}, &w.serial);
  w.state.subdomains.front().impulse[2 * contact] = kNan;
  ASSERT_TRUE(monitor.Stops(5, w.statistics, {}, w.state));
  const SolveReport report = monitor.Finish(5, 5, &w.state);
  EXPECT_EQ(report.status, SolveStatus::kDiverged);
  ExpectReason(report, "nan");
  const std::int32_t row = w.sample.problem.subdomains.front().contact[contact];
  EXPECT_EQ(report.residuals.worst_body_a, w.source.contacts.a[row]);
  EXPECT_EQ(report.residuals.worst_body_b, w.source.contacts.b[row]);
  for (const double r : w.state.subdomains.front().impulse) EXPECT_EQ(r, 0.0);
}

// An iteration whose residual may rise returns the best state that was tested, its residuals and its worst contact.
TEST(Monitor, KeepsTheBestStateOnDemand) {
  for (const bool keeps : {true, false}) {
    Watched w(SampleProblem({}));
    Sweep(w.sample.problem.subdomains.front(), &w.state.subdomains.front());
    StoppingOptions o;
    o.max_iterations = 10;
    Monitor monitor(w.sample.problem, o, &w.serial, keeps);
    ASSERT_FALSE(monitor.Stops(5, w.statistics, {}, w.state));
    const SubdomainState best = w.state.subdomains.front();
    const Residuals residuals = monitor.residuals();
    SubdomainState& last = w.state.subdomains.front();
    for (double& r : last.impulse) r *= 1e-3;
    ASSERT_TRUE(monitor.Stops(10, w.statistics, {}, w.state));
    ASSERT_GT(monitor.residuals().nat, residuals.nat);
    const SolveReport report = monitor.Finish(10, 10, &w.state);
    EXPECT_EQ(report.status, SolveStatus::kIterationLimit);
    EXPECT_EQ(report.residuals.nat == residuals.nat, keeps);
    EXPECT_EQ(last.impulse == best.impulse, keeps);
    EXPECT_EQ(last.velocity, best.velocity);
  }
}

// Nothing loads the bodies and no contact carries an impulse yet: the relative residual has no scale, which is no divergence.
TEST(Status, NoScaleIsNoDivergence) {
  Watched w(SampleProblem({}));
  w.sample.problem.scales = {.velocity = 1.0};
  Monitor monitor(w.sample.problem, {}, &w.serial);
  EXPECT_FALSE(monitor.Stops(1, w.statistics, {}, w.state));
}

// The measures of a sweep's change are blind to copies that disagree while no contact carries an impulse.
TEST(Status, QuadWaitsForTheInterfaceEvenWithoutActiveContacts) {
  Watched w(SampleProblem({}));
  StoppingOptions o;
  o.criterion = Criterion::kQuad;
  for (double& v : w.state.subdomains.front().velocity) v = 0.0;  // nothing is violated
  Monitor monitor(w.sample.problem, o, &w.serial);
  EXPECT_FALSE(monitor.Stops(1, w.statistics, {{.sum_squares = 1.0, .copies = 4.0}}, w.state));
  EXPECT_TRUE(monitor.Stops(2, w.statistics, {{.sum_squares = 1e-32, .copies = 4.0}}, w.state));  // rounding of a mean
}

TEST(TestEvery, IsRespected) {
  for (const int every : {1, 3, 7, 50}) {
    const ContactSolution s = SolveContactProblem(SampleProblem({}), Options(1e-7, 100000, every));
    EXPECT_EQ(s.report.iterations % every, 0);
    ASSERT_EQ(s.report.history.size(), static_cast<std::size_t>(s.report.iterations / every));
    for (std::size_t k = 0; k < s.report.history.size(); ++k) {
      EXPECT_EQ(s.report.history[k].iteration, static_cast<int>(every * (k + 1)));
    }
    EXPECT_EQ(s.report.history.back().nat, s.report.residuals.nat);
  }
}

// A test serves the acceleration too: plain iterates alone do not depend on it.
TEST(TestEvery, DoesNotChangePlainIterates) {
  const auto solve = [](int every) {
    NscdOptions o = Options(1e-300, 60, every);
    o.acceleration.method = Acceleration::kNone;
    return SolveContactProblem(SampleProblem({}), o);
  };
  const ContactSolution often = solve(1), rarely = solve(17);
  for (std::size_t c = 0; c < often.impulse.size(); ++c) {
    EXPECT_EQ(often.impulse[c].x, rarely.impulse[c].x);
    EXPECT_EQ(often.impulse[c].y, rarely.impulse[c].y);
  }
}

TEST(NotANumber, SurvivesTheReduction) {
  SerialCommunicator serial;
  struct Sum {
    double x;
  };
  struct Maximum {
    double x;
  };
  const std::vector<ReductionPart<Sum, Maximum>> parts{{{1.0}, {2.0}}, {{kNan}, {kNan}}, {{1.0}, {3.0}}};
  const auto total = ReduceInOrder(parts, &serial);
  EXPECT_TRUE(std::isnan(total.sum.x));
  EXPECT_TRUE(std::isnan(total.max.x));
}

// A single contact that moves is the worst one.
TEST(WorstContact, IsNamed) {
  ContactProblem p = SampleProblem({.friction = 0.0});
  for (Twist& v : p.free_velocity) v = {};
  const int bad = 17;
  p.offset[bad] = -0.1;  // asks for an opening that nobody has given yet
  Watched w(p);
  w.sample.problem.scales.velocity = 0.2;
  for (std::size_t i = 0; i < w.sample.body_id.size(); ++i)
    w.sample.body_id[i] = (std::int64_t{1} << 60) + static_cast<std::int64_t>(i);
  Monitor monitor(w.sample.problem, {}, &w.serial);
  monitor.Stops(1, w.statistics, {}, w.state);
  const SolveReport report = monitor.Finish(1, 1, &w.state);
  EXPECT_EQ(report.residuals.nat_max, 0.5);
  EXPECT_EQ(report.residuals.worst_body_a, (std::int64_t{1} << 60) + p.contacts.a[bad]);
  EXPECT_EQ(report.residuals.worst_body_b, (std::int64_t{1} << 60) + p.contacts.b[bad]);
}

TEST(BadProblems, AreRefusedWithASentence) {
  const auto refused = [](auto spoil) {
    ContactProblem p = SampleProblem({});
    spoil(&p);
    try {
      SolveContactProblem(p, NscddOptions{});
      return std::string();
    } catch (const Error& e) {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(refused([](ContactProblem*) {}), "");
  EXPECT_NE(refused([](ContactProblem* p) { p->mass[3] = -1.0; }), "");
  EXPECT_NE(refused([](ContactProblem* p) { p->free_velocity[3].vx = kNan; }), "");
  EXPECT_NE(refused([](ContactProblem* p) { p->contacts.normal[3].x += 0.1; }), "");
  EXPECT_NE(refused([](ContactProblem* p) { p->contacts.friction[3] = -0.1; }), "");
  EXPECT_NE(refused([](ContactProblem* p) { p->contacts.b[3] = 1000; }), "");
  EXPECT_NE(refused([](ContactProblem* p) { p->offset.pop_back(); }), "");
  EXPECT_NE(refused([](ContactProblem* p) { p->subdomain[3] = std::numeric_limits<int>::max(); }), "");
  EXPECT_NE(refused([](ContactProblem* p) {
              p->contacts.arm_a.assign(p->contacts.size(), {kNan, 0.0});
              p->contacts.arm_b.assign(p->contacts.size(), {});
            }),
            "");
  NscdOptions never;
  never.stopping.test_every = 0;
  EXPECT_THROW(SolveContactProblem(SampleProblem({}), never), Error);
}

}  // namespace
}  // namespace nscdd
