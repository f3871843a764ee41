// SPDX-License-Identifier: Apache-2.0
// The schedules of REA and IEA: subdomains by themselves, polish sweeps, closing updates, and what is reported of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/stages.h"
#include "nlgs/residual.h"
#include "nlgs/sweep.h"
#include "nscdd/contact_problem.h"
#include "problem/state.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Sample;
using test::SampleProblem;

constexpr int kRows = 8;  // of the column below; also the row of its wall

/// A zigzag of disks between two walls, cut in the middle: one body in two subdomains.
ContactProblem CutColumn() {
  ContactProblem p = SampleProblem({.columns = 1, .rows = kRows, .subdomains = 2});
  for (std::size_t c = 0; c < p.subdomain.size(); ++c) {
    const int a = p.contacts.a[c], b = p.contacts.b[c];
    p.subdomain[c] = (a == kRows || b == kRows ? std::min(a, b) : std::max(a, b)) >= kRows / 2;
  }
  return p;
}

// A subdomain by itself stops by the residual of its own problem, with the masses of its copies.
TEST(Subdomains, StopByTheResidualOfTheirOwnProblem) {
  const ContactProblem source = SampleProblem({.subdomains = 4});
  const Sample sample(source);
  SerialCommunicator serial;
  InterfaceWorkspace workspace;
  PartitionedState state = InitialState(sample.problem, {}), twin = state;
  AugmentedInterfaceOptions plain;
  plain.lambda = 0.0;
  Stages stages(sample.problem, plain, &serial, &workspace, &state);
  const double tolerance = 1e-6;
  const Stages::LocalResult result = stages.SolveSubdomains({.tolerance = tolerance, .max_iterations = 10000, .test_every = 1});
  EXPECT_TRUE(result.converged);
  int most = 0;
  for (std::size_t e = 0; e < twin.subdomains.size(); ++e) {
    const SubdomainProblem& p = sample.problem.subdomains[e];
    int sweeps = 0;
    for (double nat = INFINITY; nat > tolerance && sweeps < 10000; ++sweeps) {
      Sweep(p, &twin.subdomains[e]);
      const NaturalParts n = NaturalResidual(p, twin.subdomains[e], Masses::kDivided);
      nat = Nat(n.sum_e2, n.sum_r2, sample.problem.scales);
    }
    EXPECT_EQ(state.subdomains[e].impulse, twin.subdomains[e].impulse) << "subdomain " << e << ", " << sweeps << " sweeps";
    most = std::max(most, sweeps);
  }
  EXPECT_EQ(result.sweeps, most);
}

TEST(Iea, SaysWhetherTheSubdomainsReachedTheirCap) {
  const ContactProblem p = SampleProblem({.subdomains = 3});
  IeaOptions o;
  o.stopping.tolerance = 1e-6;
  for (const int cap : {3, 10000}) {
    o.stopping.max_iterations = cap;
    const SolveReport report = SolveContactProblem(p, o).report;
    EXPECT_EQ(report.status, SolveStatus::kIncomplete);
    EXPECT_EQ(report.reason.find("reached their cap") != std::string::npos, cap == 3) << report.reason;
    EXPECT_EQ(report.iterations == cap, cap == 3);
  }
}

// Polish sweeps close the contacts of the interface body, also those with inner ones.
TEST(Iea, PolishSweepsCloseTheContactsOfTheInterface) {
  const ContactProblem p = CutColumn();
  IeaOptions o;
  o.stopping.tolerance = 1e-10;
  for (const int polish : {0, 200}) {
    o.polish_sweeps = polish;
    const ContactSolution s = SolveContactProblem(p, o);
    int active = 0;
    for (std::size_t c = 0; c < p.contacts.size(); ++c) {
      const bool is_cut = p.contacts.a[c] == kRows / 2 - 1 || p.contacts.b[c] == kRows / 2 - 1;
      if (!is_cut || p.contacts.a[c] == kRows || s.impulse[c].x == 0.0) continue;
      ++active;
      EXPECT_EQ(std::abs(s.relative_velocity[c].x) < 1e-6, polish > 0) << s.relative_velocity[c].x;
    }
    EXPECT_EQ(active, 2);
  }
}

// One sweep an iteration, in the subdomains by themselves and in the closing updates.
TEST(Iea, ClosingUpdatesAddTheirSweeps) {
  const ContactProblem p = SampleProblem({.subdomains = 3});
  IeaOptions o;
  const SolveReport alone = SolveContactProblem(p, o).report;
  EXPECT_EQ(alone.sweeps, alone.iterations + 1);  // one for the status of the contacts
  o.closing_updates = 7;
  const SolveReport closed = SolveContactProblem(p, o).report;
  EXPECT_GT(closed.iterations, alone.iterations);
  EXPECT_EQ(closed.sweeps - alone.sweeps, closed.iterations - alone.iterations);
  EXPECT_LT(closed.residuals.nat, alone.residuals.nat);
}

// The jump that ends REA's first part is relative: other units of velocity change no iteration.
TEST(Rea, ItsJumpHasNoUnit) {
  const ContactProblem p = SampleProblem({.subdomains = 3});
  const SolveReport expected = SolveContactProblem(p, ReaOptions{}).report;
  EXPECT_GT(expected.interface_updates, 1);
  for (const double unit : {0x1p-20, 0x1p20}) {
    ContactProblem q = p;
    for (Twist& v : q.free_velocity) v = {unit * v.vx, unit * v.vy, unit * v.spin};
    for (Wrench& f : q.impulse) f = {unit * f.fx, unit * f.fy, unit * f.torque};
    const SolveReport report = SolveContactProblem(q, ReaOptions{}).report;
    EXPECT_EQ(report.interface_updates, expected.interface_updates) << unit;
    EXPECT_EQ(report.iterations, expected.iterations) << unit;
    EXPECT_EQ(report.residuals.relative_jump, expected.residuals.relative_jump) << unit;
  }
}

}  // namespace
}  // namespace nscdd
