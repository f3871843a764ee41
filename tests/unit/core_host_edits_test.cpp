// SPDX-License-Identifier: Apache-2.0
// What the host's user does between steps, what a host does wrong, and continuation from a saved state.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "host.h"
#include "nscdd/error.h"
#include "packing.h"

namespace nscdd {
namespace {

using test::Exact;
using test::Host;

constexpr double kG = 9.81;
constexpr double kDt = 0.01;

NscddOptions Nscdd(int nx, int ny, int repartition_every = 1) {
  NscddOptions o;
  o.partition = {nx, ny, repartition_every};
  return o;
}

std::string Refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

void ExpectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' has no '" << part << "'";
}

TEST(HostEdits, BodiesComeGoAndMove) {
  Host host({}, Nscdd(2, 2));
  host.world.gravity = {0.0, -kG};
  host.AddFloor(0, 0.3);
  for (int i = 0; i < 3; ++i) host.AddDisk(10 + i, {0.0, 0.5 + i}, 0.5, 0.3);
  host.Step(10, kDt);
  host.world.Remove(10);
  const StepReport& fewer = host.Step(kDt);
  EXPECT_EQ(fewer.bodies, 2);
  EXPECT_NEAR(host.body(11).velocity.vy, -kG * kDt, 1e-3);   // nothing holds it any more
  host.AddDisk(10, {0.0, 7.0}, 0.4, 0.3).velocity.vx = 1.0;  // the same id, another body
  EXPECT_EQ(host.Step(kDt).bodies, 3);
  EXPECT_NEAR(host.body(10).pose.x, kDt, 1e-15);
  host.body(12).pose = {50.0, 80.0, 2.0};
  host.body(12).velocity = {1.0, 0.0, 3.0};
  host.Step(kDt);
  EXPECT_NEAR(host.body(12).pose.x, 50.0 + kDt, 1e-13);
  EXPECT_NEAR(host.body(12).pose.angle, 2.0 + 3.0 * kDt, 1e-14);
  host.body(12).force.fy = 2.0 * kG * host.body(12).mass;
  host.body(12).velocity = {};
  host.Step(kDt);
  EXPECT_NEAR(host.body(12).velocity.vy, kG * kDt, 1e-14);
}

// A refused step changes nothing, and the next one goes on as if it had not been.
TEST(HostErrors, NameTheBodyAndLeaveTheHostAlone) {
  Host host({}, Exact()), twin({}, Exact());
  for (Host* h : {&host, &twin}) {
    h->world.gravity = {1.0, -kG};
    h->AddFloor(0, 0.5);
    h->AddDisk(7, {0.0, 0.5}, 0.5, 0.5);
    h->Step(5, kDt);
  }
  const Pose before = host.body(7).pose;
  const Twist velocity = host.body(7).velocity;
  host.body(7).velocity.vx = std::numeric_limits<double>::quiet_NaN();
  ExpectContains(Refusal([&] { host.Step(kDt); }), "7");
  EXPECT_EQ(host.body(7).pose.x, before.x);
  host.body(7).velocity = velocity;
  for (const double dt : {0.0, -0.01, std::numeric_limits<double>::infinity(), std::nan("")}) {
    ExpectContains(Refusal([&] { host.Step(dt); }), "time step");
  }
  const double mass = host.body(7).mass;
  host.body(7).mass = 1e-10;
  host.body(7).force.fy = -1e308;
  ExpectContains(Refusal([&] { host.Step(kDt); }), "body 7 that is not finite");
  host.body(7).mass = mass;
  host.body(7).force = {};
  host.Step(5, kDt);
  const StepReport& report = twin.Step(5, kDt);
  EXPECT_EQ(report.step, 10);
  EXPECT_EQ(host.stepper().Step(kDt).step, 11);
  twin.Step(kDt);
  EXPECT_EQ(host.body(7).pose.x, twin.body(7).pose.x);
  EXPECT_EQ(host.body(7).velocity.spin, twin.body(7).velocity.spin);
}

TEST(HostErrors, ImpossibleNumbersOfTheSolverAreNotWrittenBack) {
  Host host({}, Exact());
  host.AddDisk(7, {0.0, 0.5}, 0.5).force.fx = 1e308;
  host.body(7).mass = 1e-10;
  host.body(7).inertia = 1e-10;
  ExpectContains(Refusal([&] { host.Step(kDt); }), "body 7");
  EXPECT_EQ(host.body(7).pose.x, 0.0);
}

TEST(Options, ImpossibleOnesAreRefused) {
  const auto refusal = [](const SteppingOptions& s, const AlgorithmOptions& a) {
    return Refusal([&] {
      Host host(s, a);
      host.stepper();
    });
  };
  EXPECT_EQ(refusal({}, NscdOptions{}), "");
  ExpectContains(refusal({.theta = 0.4}, NscdOptions{}), "option 'theta' is '0.4'");
  ExpectContains(refusal({.feedback_beta = 1.5}, NscdOptions{}), "feedback_beta");
  ExpectContains(refusal({.feedback_slop = -1.0}, NscdOptions{}), "feedback_slop");
  ExpectContains(refusal({.alert_distance = std::nan("")}, NscdOptions{}), "alert_distance");
  ExpectContains(refusal({}, Nscdd(0, 2)), "0x2");
  ExpectContains(refusal({}, Nscdd(100000, 100000)), "100000x100000");
  ExpectContains(refusal({}, Nscdd(2, 2, 0)), "repartition_every");
  NscdOptions o;
  o.stopping.tolerance = std::nan("");
  ExpectContains(refusal({}, o), "tolerance");
  o = {};
  o.stopping.test_every = 0;
  ExpectContains(refusal({}, o), "test_every");
}

/// A tilted packing with NSCDD.
struct Piled : Host {
  explicit Piled(const AlgorithmOptions& o, const SteppingOptions& s = {}) : Host(s, o) { world.gravity = {3.0, -9.0}; }
  void Fill() {
    for (const reference::Body& b : test::MakeBodies({.columns = 8, .rows = 6})) world.Add(b);
  }
};

void ExpectSameBodies(Host* one, Host* other) {
  for (const reference::Body& b : one->world.bodies()) {
    const reference::Body& twin = other->body(b.id);
    ASSERT_EQ(b.pose.x, twin.pose.x) << "body " << b.id;
    ASSERT_EQ(b.pose.y, twin.pose.y);
    ASSERT_EQ(b.pose.angle, twin.pose.angle);
    ASSERT_EQ(b.velocity.vx, twin.velocity.vx);
    ASSERT_EQ(b.velocity.spin, twin.velocity.spin);
  }
}

// Saved between two placements of the cuts.
TEST(Continuation, IsTheUninterruptedRun) {
  Piled whole(Nscdd(3, 2, 4)), first(Nscdd(3, 2, 4)), second(Nscdd(3, 2, 4));
  whole.Fill();
  first.Fill();
  whole.Step(6, kDt);
  first.Step(6, kDt);
  const std::vector<std::byte> saved = first.stepper().SaveState();
  for (const reference::Body& b : first.world.bodies()) second.world.Add(b);
  second.stepper().LoadState(saved);
  for (int k = 0; k < 10; ++k) {
    const double dt = k == 0 ? 0.5 * kDt : kDt;
    const StepReport &a = whole.Step(dt), &b = second.Step(dt);
    ASSERT_EQ(a.step, b.step);
    ASSERT_EQ(a.time, b.time);
    ASSERT_EQ(a.solve.iterations, b.solve.iterations);
    ASSERT_EQ(a.solve.residuals.nat, b.solve.residuals.nat);
    ASSERT_EQ(a.alert_distance, b.alert_distance);
  }
  ExpectSameBodies(&whole, &second);
}

// Without the state the run is another one: the test above can fail.
TEST(Continuation, NeedsTheState) {
  Piled whole(Nscdd(3, 2)), second(Nscdd(3, 2));
  whole.Fill();
  whole.Step(6, kDt);
  for (const reference::Body& b : whole.world.bodies()) second.world.Add(b);
  EXPECT_NE(whole.Step(kDt).solve.residuals.nat, second.Step(kDt).solve.residuals.nat);
}

// Saved between two placements of the cuts, which fit nobody any more; the impulses of contacts do.
TEST(Continuation, OnOtherSubdomains) {
  Piled first(Nscdd(3, 2, 4)), warm(Nscdd(2, 3, 4)), cold(Nscdd(2, 3, 4));
  first.Fill();
  first.Step(42, kDt);
  const std::vector<std::byte> saved = first.stepper().SaveState();
  for (const reference::Body& b : first.world.bodies()) {
    warm.world.Add(b);
    cold.world.Add(b);
  }
  warm.stepper().LoadState(saved);
  const StepReport &a = warm.Step(kDt), &b = cold.Step(kDt);
  EXPECT_EQ(a.step, 43);
  EXPECT_EQ(a.solve.subdomains, 6);
  EXPECT_EQ(a.solve.status, SolveStatus::kConverged);
  EXPECT_LT(a.solve.iterations, b.solve.iterations);
}

TEST(Continuation, BytesThatAreNoStateAreRefusedAndChangeNothing) {
  Piled pile(Nscdd(2, 2)), twin(Nscdd(2, 2));
  for (Piled* p : {&pile, &twin}) {
    p->Fill();
    p->Step(3, kDt);
  }
  std::vector<std::byte> saved = pile.stepper().SaveState();
  const auto refused = [&](std::vector<std::byte> bytes) { return Refusal([&] { pile.stepper().LoadState(bytes); }); };
  EXPECT_NE(refused({}), "");
  EXPECT_NE(refused(std::vector<std::byte>(400, std::byte{1})), "");
  EXPECT_NE(refused({saved.begin(), saved.end() - 1}), "");
  EXPECT_NE(refused({saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(saved.size() / 2)}), "");
  std::vector<std::byte> longer = saved;
  longer.push_back(std::byte{0});
  EXPECT_NE(refused(longer), "");
  const auto not_finite = std::bit_cast<std::array<std::byte, 8>>(std::numeric_limits<double>::infinity());
  std::vector<std::byte> damaged(saved.begin(), saved.end() - 8);  // the last number is an interface impulse
  damaged.insert(damaged.end(), not_finite.begin(), not_finite.end());
  ExpectContains(refused(damaged), "an impulse in it is not finite");
  std::vector<std::byte> older = saved;
  older[7] = static_cast<std::byte>('2');  // the layout before this one
  ExpectContains(refused(older), "another version");
  const std::span<const std::byte> part(saved);
  const std::array twice{part, part};
  ExpectContains(Refusal([&] { pile.stepper().LoadState(twice); }), "1 ranks saved the state and 2 parts");
  ExpectContains(Refusal([&] { pile.stepper().LoadState(std::span<const std::span<const std::byte>>{}); }), "no saved state");
  pile.Step(3, kDt);
  twin.Step(3, kDt);
  ExpectSameBodies(&pile, &twin);
}

// Cuts follow the bodies only at the steps that were asked for.
TEST(Repartition, EveryKSteps) {
  for (const int every : {1, 3}) {
    Host host({.normal_law = NormalLaw::kGap}, Nscdd(2, 1, every));  // cuts where contacts are detected
    host.AddDisk(1, {0.0, 0.0}, 0.5);
    host.AddDisk(2, {5.6, 0.0}, 0.5);
    host.AddDisk(3, {10.0, 0.0}, 0.5).velocity.vx = 1.0;  // the cut lies half-way between 1 and 3
    for (int step = 1; step <= 8; ++step) {
      host.Step(1.0);
      const int placed = 1 + (step - 1) / every * every;  // the step in which the cuts were placed
      const double cut = 0.5 * (10.0 + placed - 0.5);
      EXPECT_EQ(host.stepper().bodies().subdomain[1], 5.6 >= cut ? 1 : 0) << "step " << step << " every " << every;
    }
  }
}

// Ids are names: any number up to 2^63 - 1, and results do not depend on them.
TEST(Ids, LargeOnesAreToldApart) {
  FeaOptions options;
  options.partition = {2, 2, 1};
  options.interface.solve = InterfaceSolve::kDirect;
  Piled small(options), large(options);
  small.Fill();
  constexpr std::int64_t kShift = (std::int64_t{1} << 62) + 1;
  for (reference::Body b : small.world.bodies()) {
    b.id += kShift;
    large.world.Add(b);
  }
  for (int k = 0; k < 5; ++k) {
    const StepReport &a = small.Step(kDt), &b = large.Step(kDt);
    ASSERT_EQ(a.solve.iterations, b.solve.iterations);
    ASSERT_EQ(a.solve.residuals.nat, b.solve.residuals.nat);
  }
}

TEST(Continuation, StateOfAnotherPeriodIsRefused) {
  const auto state_of = [](double period, double origin) {
    Host host({}, Nscdd(2, 1));
    host.world.period = period;
    host.world.period_origin = origin;
    host.AddDisk(1, {5.0, 0.0}, 0.5);
    host.Step(kDt);
    return host.stepper().SaveState();
  };
  Host host({}, Nscdd(2, 1));
  host.world.period = 12.0;
  host.AddDisk(1, {5.0, 0.0}, 0.5);
  EXPECT_EQ(Refusal([&] { host.stepper().LoadState(state_of(12.0, 0.0)); }), "");
  for (const auto& state : {state_of(10.0, 0.0), state_of(12.0, 1.0), state_of(0.0, 0.0)}) {
    ExpectContains(Refusal([&] { host.stepper().LoadState(state); }), "another period than 12 m from 0 m");
  }
}

}  // namespace
}  // namespace nscdd
