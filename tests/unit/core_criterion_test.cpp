// SPDX-License-Identifier: Apache-2.0
// "Converged" bounds what many contacts do together: loads that have not reached the ground, scenes without a solution,
// momentum.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host.h"
#include "nlgs/residual.h"
#include "nscdd/contact_problem.h"
#include "nscdd/error.h"
#include "sample_problem.h"
#include "stepping/step_problem.h"

namespace nscdd {
namespace {

using test::Host;
using test::SampleProblem;

constexpr double kG = 9.81, kDt = 0.01;

template <class Options>
Options On(int nx, int ny) {
  Options o;
  o.partition.nx = nx;
  o.partition.ny = ny;
  return o;
}

std::vector<AlgorithmOptions> AllSolvers() {
  return {NscdOptions{},        On<NscddOptions>(2, 2), On<FeaOptions>(2, 2),
          On<ReaOptions>(2, 2), On<IeaOptions>(2, 2),   NewtonOptions{}};
}

void AddColumn(int count, Host* host) {
  host->world.gravity = {0.0, -kG};
  host->AddFloor(0, 0.3);
  for (int i = 0; i < count; ++i) host->AddDisk(1 + i, {0.0, 0.5 + i}, 0.5, 0.3);
}

/// Impulse of the floor in units of the weight, in a step from rest.
double FloorShare(Host* host) {
  const StepReport& report = host->Step(kDt);
  double mass = 0.0;
  for (const reference::Body& b : host->world.bodies()) mass += b.kind == BodyKind::kFree ? b.mass : 0.0;
  return 1.0 + report.momentum_y / (mass * kG * kDt);
}

// The first step of a column, from zero impulses: nat alone is content with 22 % of the weight of 200 disks.
TEST(Criterion, TheLoadReachesTheGround) {
  for (const int count : {5, 20, 100, 200}) {
    for (const AlgorithmOptions& solver : {AlgorithmOptions{NscdOptions{}}, AlgorithmOptions{On<NscddOptions>(1, 4)},
                                           AlgorithmOptions{On<FeaOptions>(1, 4)}, AlgorithmOptions{NewtonOptions{}}}) {
      Host host({}, solver);
      AddColumn(count, &host);
      const double share = FloorShare(&host);
      const SolveReport& solve = host.stepper().Step(kDt).solve;
      EXPECT_EQ(solve.status, SolveStatus::kConverged) << solve.reason;
      EXPECT_NEAR(share, 1.0, 0.01) << count << " disks, solver " << solver.index();
    }
  }
}

// Plain sweeps are slow, but do not say that they are done before the load is down.
TEST(Criterion, HoldsPlainSweepsToIt) {
  NscdOptions plain;
  plain.acceleration.method = Acceleration::kNone;
  for (const double tolerance : {1e-2, 1e-4}) {
    plain.stopping.tolerance = tolerance;
    Host host({}, plain);
    AddColumn(50, &host);
    const double share = FloorShare(&host);
    EXPECT_NEAR(share, 1.0, BoundsOf(plain.stopping).load_error * 1.2) << tolerance;
  }
}

TEST(Criterion, BoundsFollowTheToleranceWithinLimits) {
  StoppingOptions o;
  const auto load = [&](double tolerance) {
    o.tolerance = tolerance;
    return BoundsOf(o).load_error;
  };
  EXPECT_EQ(load(1e-12), 0.008);
  EXPECT_EQ(load(1e-3), 0.008);
  EXPECT_EQ(load(5e-3), 0.04);
  EXPECT_EQ(load(1.0), 0.08);
  EXPECT_EQ(BoundsOf(o).power, 1.0);
  o.criterion = Criterion::kQm16;  // LMGC90's own, but for scenes without a solution
  EXPECT_TRUE(std::isinf(BoundsOf(o).load_error));
  Residuals r;
  r.power = 2.0;
  o.tolerance = 1e-3;
  EXPECT_EQ(Measure(o, r), 2e-3);
  r = {};
  r.load_error = 0.3;
  o.criterion = Criterion::kNatMax;
  EXPECT_DOUBLE_EQ(Measure(o, r), 1e-3 * 0.3 / 0.008);
  o.tolerance = 0.0;
  EXPECT_EQ(Measure(o, r), 0.0);
}

// Prescribed walls that close on a row of disks leave no room: whoever solves it says so and names them.
TEST(Squeezed, BodiesAreNamedByEverySolver) {
  for (const AlgorithmOptions& solver : AllSolvers()) {
    Host host({}, solver);
    reference::Body left = reference::MakeWall(10), right = reference::MakeWall(11);
    left.half_planes = {{{1.0, 0.0}, 0.0}};
    right.half_planes = {{{-1.0, 0.0}, -6.0}};
    right.velocity.vx = -1.0;
    host.world.Add(left);
    host.world.Add(right);
    for (int i = 0; i < 3; ++i) host.AddDisk(20 + i, {1.0 + 2.0 * i, 0.0}, 1.0, 0.3);
    for (int i = 0; i < 20; ++i) host.AddDisk(100 + i, {3.0, 50.0 + 2.0 * i}, 1.0, 0.3);  // at ease
    SolveReport solve;
    for (int step = 0; step < 5 && solve.squeezed.empty(); ++step) solve = host.Step(kDt).solve;
    EXPECT_FALSE(IsAsAsked(solve.status)) << solver.index() << ": " << solve.reason;
    EXPECT_NE(solve.reason.find("squeeze: "), std::string::npos) << solver.index() << ": " << solve.reason;
    const std::vector<std::int64_t> row{10, 11, 20, 21, 22};
    if (std::holds_alternative<ReaOptions>(solver) || std::holds_alternative<IeaOptions>(solver)) {
      // Where their interface stays as it is, some contacts of the row violate little.
      EXPECT_GE(solve.squeezed.size(), 2u) << solver.index();
      EXPECT_TRUE(std::includes(row.begin(), row.end(), solve.squeezed.begin(), solve.squeezed.end())) << solver.index();
    } else {
      EXPECT_EQ(solve.squeezed, row) << solver.index();
    }
  }
}

// A load that only turns is a load: nat_max has a scale, and power too.
TEST(Criterion, TorqueIsALoad) {
  std::vector<ProblemPart> parts(1);
  AddBody(2.0, 0.5, 1.0, {0.0, 0.0, 3.0}, kDt, &parts.front());
  SerialCommunicator serial;
  const ResidualScales scales = ReduceTotals(parts, ContactModel::kFriction, &serial).scales;
  EXPECT_DOUBLE_EQ(scales.velocity, 3.0 * kDt);  // over sqrt(m I)
  EXPECT_DOUBLE_EQ(scales.exchange, 9.0 * kDt * kDt / 0.5);
  EXPECT_EQ(scales.energy, 0.0);
}

/// Sum of |dt f| [N s].
double ImpulseOf(const ContactProblem& p) {
  double sum = 0.0;
  for (const Wrench& f : p.impulse) sum += std::hypot(f.fx, f.fy);
  return sum;
}

// wall_error is an estimate from above: the impulse on the prescribed bodies against that of a tight solution of the same
// problem.
TEST(WallError, BoundsTheErrorFromAbove) {
  int checked = 0;
  for (int rows = 2; rows < 12; ++rows) {
    for (const double friction : {0.0, 0.3}) {
      for (const int sweeps : {3, 10, 30, 60, 100}) {
        const ContactProblem p = SampleProblem({.columns = 6, .rows = rows, .friction = friction});
        const auto momentum = [&](const ContactSolution& s) {
          Vec2 sum{};
          for (std::size_t i = 0; i < p.mass.size(); ++i) {
            if (!std::isinf(p.mass[i])) sum = sum + p.mass[i] * Linear(s.velocity[i]);
          }
          return sum;
        };
        NscdOptions few, tight;
        few.stopping.tolerance = 0.0;
        few.stopping.max_iterations = sweeps;
        tight.stopping.criterion = Criterion::kNatMax;
        tight.stopping.tolerance = 1e-10;
        tight.stopping.max_iterations = 100000;
        const ContactSolution rough = SolveContactProblem(p, few), exact = SolveContactProblem(p, tight);
        if (exact.report.status != SolveStatus::kConverged) continue;
        const double rounding = exact.report.residuals.wall_error + 1e-8 * ImpulseOf(p);
        EXPECT_LE(Norm(momentum(rough) - momentum(exact)), rough.report.residuals.wall_error + rounding)
            << rows << " rows, friction " << friction << ", " << sweeps << " sweeps";
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, 90);
}

/// Six disks in a pyramid on the floor, and one beside them that is `ratio` times as heavy.
void AddPyramidBesideHeavy(double ratio, Host* host) {
  host->world.gravity = {1.9, -9.6};
  host->AddFloor(0, 0.3);
  const double height = std::sqrt(3.0);
  for (const auto& [id, centre] : {std::pair{1, Vec2{0, 1}},
                                   {2, Vec2{2, 1}},
                                   {3, Vec2{4, 1}},
                                   {4, Vec2{1, 1 + height}},
                                   {5, Vec2{3, 1 + height}},
                                   {6, Vec2{2, 1 + 2 * height}}}) {
    host->AddDisk(id, centre, 1.0, 0.3);
  }
  reference::Body heavy = reference::MakeDisk(7, {50.0, 1.0}, 1.0, 1000.0 * ratio);
  heavy.friction = 0.3;
  host->world.Add(heavy);
}

// lambda times the mean mass is far above the mass of the light bodies: what the interface gives their copies must still sum to
// zero. Where it cannot, it is refused.
TEST(Momentum, InterfaceImpulsesSumToZero) {
  for (const double ratio : {1.0, 1e4, 1e6, 1e8}) {
    for (const Acceleration method : {Acceleration::kAnderson, Acceleration::kNone}) {
      FeaOptions fea = On<FeaOptions>(1, 2);
      fea.acceleration.method = method;
      fea.stopping = {.criterion = Criterion::kNatMax, .tolerance = 1e-9, .max_iterations = 5000};
      Host host({}, fea);
      AddPyramidBesideHeavy(ratio, &host);
      const SolveReport solve = host.Step(kDt).solve;
      EXPECT_LT(solve.imbalance, 1e-12) << ratio << ": " << solve.reason;
      EXPECT_GE(solve.interface_bodies, 2);
    }
  }
  Host host({}, On<FeaOptions>(1, 2));
  AddPyramidBesideHeavy(1e14, &host);
  EXPECT_THROW(host.Step(kDt), Error);
}

}  // namespace
}  // namespace nscdd
