// SPDX-License-Identifier: Apache-2.0
// A scene pays for what it requires and for nothing else: unknowns, bytes, messages, interface.

#include <gtest/gtest.h>

#include <set>

#include "host.h"
#include "packing.h"
#include "problem/state.h"
#include "rows.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Host;
using test::Packing;

NscddOptions Nscdd(int nx, int ny) {
  NscddOptions o;
  o.partition = {nx, ny, 1};
  o.stopping.tolerance = 1e-6;
  return o;
}

SolveReport LastOf(const Packing& packing, const AlgorithmOptions& algorithm) {
  SerialCommunicator serial;
  return test::Run(packing, {}, algorithm, 3, &serial).reports.back().solve;
}

TEST(Counters, FrictionlessDisks) {
  const SolveReport r = LastOf({.friction = 0.0}, NscdOptions{});
  EXPECT_EQ(r.unknowns_per_contact, 1);
  EXPECT_EQ(r.unknowns_per_body, 2);
  EXPECT_EQ(r.bytes_per_contact, 48);
  EXPECT_EQ(r.bytes_per_body, 24);
}

TEST(Counters, DisksWithFriction) {
  const SolveReport r = LastOf({}, NscdOptions{});
  EXPECT_EQ(r.unknowns_per_contact, 2);
  EXPECT_EQ(r.unknowns_per_body, 3);
  EXPECT_EQ(r.bytes_per_contact, 88);
  EXPECT_EQ(r.bytes_per_body, 40);
}

// Walls have arms, and they may turn: that costs the disks nothing.
TEST(Counters, WallsDoNotSwitchTheModel) {
  EXPECT_EQ(LastOf({.turning_wall = true}, NscdOptions{}).bytes_per_contact, 88);
  EXPECT_EQ(LastOf({.friction = 0.0, .turning_wall = true}, NscdOptions{}).bytes_per_contact, 48);
  EXPECT_EQ(LastOf({.friction = 0.0, .periodic = true}, NscdOptions{}).bytes_per_contact, 48);
  EXPECT_EQ(LastOf({.friction = 0.0, .restitution = 0.5}, NscdOptions{}).bytes_per_contact, 48);
}

TEST(Counters, ClustersPayForTheirArms) {
  const SolveReport smooth = LastOf({.friction = 0.0, .clusters = true}, NscdOptions{});
  EXPECT_EQ(smooth.unknowns_per_contact, 1);
  EXPECT_EQ(smooth.unknowns_per_body, 3);
  EXPECT_EQ(smooth.bytes_per_contact, 64);
  const SolveReport rough = LastOf({.clusters = true}, NscdOptions{});
  EXPECT_EQ(rough.unknowns_per_contact, 2);
  EXPECT_EQ(rough.unknowns_per_body, 3);
  EXPECT_EQ(rough.bytes_per_contact, 112);
}

/// One rank, and every call that ought not to happen there.
class Lonely final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void AllReduceMin(std::span<double>) override {}
  std::vector<double> AllGather(std::span<const double> values) override { return {values.begin(), values.end()}; }
  void Broadcast(int, std::vector<std::byte>*) override { ++calls; }
  std::vector<Message> Deliver(std::vector<Message>) override {
    ++calls;
    return {};
  }
  void Exchange(std::span<const Outgoing>, std::span<const Incoming>) override { ++calls; }
  int calls = 0;
};

TEST(Counters, OneRankSendsNothing) {
  Lonely lonely;
  for (const StepReport& r : test::Run({}, {}, Nscdd(3, 2), 5, &lonely).reports) {
    EXPECT_EQ(r.messages, 0);
    EXPECT_EQ(r.message_bytes, 0);
    EXPECT_EQ(r.collectives, 0);
    EXPECT_EQ(r.migrated_bodies, 0);
    EXPECT_GT(r.solve.interface_bodies, 0);
  }
  EXPECT_EQ(lonely.calls, 0);
}

TEST(Counters, OneSubdomainHasNoInterface) {
  for (const AlgorithmOptions& o : {AlgorithmOptions(NscdOptions{}), AlgorithmOptions(Nscdd(1, 1))}) {
    const SolveReport r = LastOf({}, o);
    EXPECT_EQ(r.interface_bodies, 0);
    EXPECT_EQ(r.interface_copies, 0);
    EXPECT_EQ(r.max_multiplicity, 1);
    EXPECT_EQ(r.residuals.interface_jump, 0.0);
  }
  const test::Sample sample(test::SampleProblem({}));
  EXPECT_TRUE(sample.problem.interface.copies.empty());
  EXPECT_TRUE(sample.problem.subdomains.front().multiplicity.empty());
  EXPECT_EQ(sample.problem.interface.slot_count(), 0);
}

TEST(Sharing, PairsInAnyOrderRepeatedOrNot) {
  const Sharing s = MakeSharing(4, {{2, 7}, {0, 3}, {2, 1}, {2, 7}, {0, 3}, {3, 0}, {2, 4}});
  const auto of = [&](std::size_t row) { return std::vector<std::int32_t>(s.Of(row).begin(), s.Of(row).end()); };
  EXPECT_EQ(of(0), std::vector<std::int32_t>{3});
  EXPECT_TRUE(of(1).empty());
  EXPECT_EQ(of(2), (std::vector<std::int32_t>{1, 4, 7}));
  EXPECT_EQ(of(3), std::vector<std::int32_t>{0});
  EXPECT_EQ(s.Multiplicity(2), 3);
  EXPECT_TRUE(MakeSharing(0, {}).subdomain.empty());
}

// The wall touches every subdomain and is in none of the interface's lists.
TEST(Interface, FixedBodiesAreNeverOnIt) {
  const ContactProblem p = test::SampleProblem({.subdomains = 5});
  const test::Sample sample(p);
  const auto wall = static_cast<std::int32_t>(p.mass.size() - 1);
  std::set<int> touched;
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    if (p.contacts.a[c] == wall) touched.insert(p.subdomain[c]);
  }
  ASSERT_EQ(touched.size(), 5u);
  const InterfaceMap& map = sample.problem.interface;
  ASSERT_FALSE(map.row.empty());
  for (const std::int32_t row : map.row) EXPECT_NE(row, wall);
  for (const auto& copy : map.copies) EXPECT_NE(sample.problem.subdomains[copy.problem].body[copy.body], wall);
}

TEST(Interface, WallsHaveNoMultiplicity) {
  Host host({}, Nscdd(4, 3));
  host.world.gravity = {0.0, -9.81};
  for (const reference::Body& b : test::MakeBodies({})) host.world.Add(b);
  const StepReport& report = host.Step(0.01);
  std::int64_t bodies = 0, copies = 0;
  int most = 0;
  for (const test::BodyRow& b : test::Rows(host.stepper().bodies())) {
    if (b.kind == BodyKind::kPrescribed) {
      EXPECT_EQ(b.multiplicity, 0);
    }
    bodies += b.multiplicity > 1;
    copies += b.multiplicity > 1 ? b.multiplicity : 0;
    most = std::max(most, b.multiplicity);
  }
  EXPECT_EQ(report.solve.interface_bodies, bodies);
  EXPECT_EQ(report.solve.interface_copies, copies);
  EXPECT_EQ(report.solve.max_multiplicity, most);
}

// A grain among six others, cut into so many cells that each contact has its own.
TEST(Interface, OneBodyInSixSubdomains) {
  const auto build = [](const AlgorithmOptions& algorithm) {
    Host host({}, algorithm);
    host.AddDisk(0, {0.0, 0.0}, 0.5, 0.3).velocity = {0.1, 0.2, 0.3};
    for (int k = 0; k < 6; ++k) {
      const Vec2 n = Rotate(0.2 + k * 1.0471975511965976, {1.0, 0.0});
      host.AddDisk(1 + k, 0.8 * n, 0.3, 0.3).velocity = {-0.1 * (k + 1) * n.x, -0.1 * (k + 1) * n.y, 0.0};
    }
    return host;
  };
  NscddOptions nscdd = Nscdd(9, 9);
  nscdd.stopping = test::Exact().stopping;
  nscdd.stopping.tolerance = 1e-12;
  Host whole = build(test::Exact()), parts = build(nscdd);
  whole.Step(0.01);
  const StepReport& report = parts.Step(0.01);
  EXPECT_EQ(report.solve.status, SolveStatus::kConverged) << report.solve.reason;
  EXPECT_EQ(report.solve.max_multiplicity, 6);
  EXPECT_EQ(report.solve.interface_bodies, 1);
  EXPECT_EQ(report.solve.empty_subdomains, 81 - 6);
  EXPECT_EQ(parts.stepper().bodies().multiplicity[0], 6);
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(whole.body(i).velocity.vx, parts.body(i).velocity.vx, 1e-9);
    EXPECT_NEAR(whole.body(i).velocity.vy, parts.body(i).velocity.vy, 1e-9);
  }
}

// Subdomains smaller than a grain: most are empty, every grain is on the interface, the solution is the same.
TEST(Interface, FortyByForty) {
  SerialCommunicator serial;
  NscddOptions fine = Nscdd(40, 40);
  fine.stopping.max_iterations = 100000;
  NscdOptions nscd;
  nscd.stopping = fine.stopping;
  const Packing packing{.friction = 0.0};
  const test::Outcome whole = test::Run(packing, {}, nscd, 2, &serial), parts = test::Run(packing, {}, fine, 2, &serial);
  const SolveReport& report = parts.reports.back().solve;
  EXPECT_EQ(report.status, SolveStatus::kConverged) << report.reason;
  EXPECT_EQ(report.subdomains, 1600);
  EXPECT_GT(report.empty_subdomains, 1300);
  EXPECT_GE(report.max_multiplicity, 4);
  EXPECT_GT(report.interface_bodies, 100);
  for (std::size_t i = 0; i < whole.bodies.size(); ++i) {
    EXPECT_NEAR(whole.bodies[i].velocity.vx, parts.bodies[i].velocity.vx, 1e-3);
    EXPECT_NEAR(whole.bodies[i].velocity.vy, parts.bodies[i].velocity.vy, 1e-3);
  }
}

}  // namespace
}  // namespace nscdd
