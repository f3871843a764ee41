// SPDX-License-Identifier: Apache-2.0
// Solver newton: its sparse factorisation, golden problems, scenes that NLGS solves too, limits.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <random>

#include "host.h"
#include "newton/block_lu.h"
#include "newton/library_lu.h"
#include "nscdd/contact_problem.h"
#include "nscdd/error.h"
#include "packing.h"
#include "problem/problem_file.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Packing;
using test::SampleProblem;

/// A diagonally dominant matrix on a lattice of 9 x 7 nodes with diagonals, not symmetric.
template <int B>
BlockMatrix<B> LatticeMatrix() {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (int i = 0; i < 63; ++i) {
    if (i % 9 < 8) edges.emplace_back(i, i + 1);
    if (i + 9 < 63) edges.emplace_back(i + 9, i);
    if (i % 9 < 8 && i + 10 < 63) edges.emplace_back(i, i + 10);
  }
  edges.push_back(edges.front());
  BlockMatrix<B> matrix;
  matrix.SetPattern(63, edges);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (double& x : matrix.values) x = number(random);
  for (int i = 0; i < 63; ++i) {
    for (int d = 0; d < B; ++d) matrix.Block(matrix.Place(i, i))[B * d + d] += 20.0;
  }
  return matrix;
}

template <int B>
void ExpectSolves(LinearLibrary library) {
  const BlockMatrix<B> matrix = LatticeMatrix<B>();
  const int n = B * matrix.rows();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < matrix.rows(); ++i) {
    for (std::int32_t k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k) {
      for (int r = 0; r < B; ++r) {
        for (int c = 0; c < B; ++c) dense(B * i + r, B * matrix.column[k] + c) = matrix.Block(k)[B * r + c];
      }
    }
  }
  const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
  const auto factor = MakeBlockFactor<B>(library);
  factor->Analyse(matrix);
  for (const double scale : {1.0, 2.0}) {  // the pattern is used again
    BlockMatrix<B> scaled = matrix;
    for (double& x : scaled.values) x *= scale;
    ASSERT_TRUE(factor->Factorise(scaled));
    Eigen::VectorXd x = scale * dense * expected;
    factor->Solve(x.data());
    EXPECT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(BlockFactor, SolvesGeneralBlockMatrices) {
  for (const LinearLibrary library : {LinearLibrary::kAuto, LinearLibrary::kEigen}) {
    ExpectSolves<2>(library);
    ExpectSolves<3>(library);
  }
}

TEST(BlockFactor, SaysThatAMatrixIsSingular) {
  BlockMatrix<2> matrix = LatticeMatrix<2>();
  std::fill(matrix.values.begin(), matrix.values.end(), 0.0);
  for (const LinearLibrary library : {LinearLibrary::kAuto, LinearLibrary::kEigen}) {
    const auto factor = MakeBlockFactor<2>(library);
    factor->Analyse(matrix);
    EXPECT_FALSE(factor->Factorise(matrix));
  }
}

NewtonOptions To(double nat_max) {
  NewtonOptions o;
  o.stopping.criterion = Criterion::kNatMax;
  o.stopping.tolerance = nat_max;
  return o;
}

TEST(Newton, ReachesTheGoldenVelocities) {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(NSCDD_SOURCE_DIR) + "/tests/data/golden")) {
    if (entry.path().extension() != ".json") continue;
    const ProblemFile file = ReadProblemFile(entry.path().string());
    NscdOptions nscd;
    nscd.stopping = {.tolerance = 1e-14, .max_iterations = 1000000};
    const ContactSolution truth = SolveContactProblem(file.problem, nscd), s = SolveContactProblem(file.problem, To(1e-9));
    EXPECT_EQ(s.report.status, SolveStatus::kConverged) << entry.path() << ": " << s.report.reason;
    EXPECT_EQ(s.report.sweeps, s.report.iterations);
    for (std::size_t i = 0; i < s.velocity.size(); ++i) {
      EXPECT_NEAR(s.velocity[i].vx, truth.velocity[i].vx, 1e-8) << entry.path() << " body " << i;
      EXPECT_NEAR(s.velocity[i].vy, truth.velocity[i].vy, 1e-8) << entry.path() << " body " << i;
      EXPECT_NEAR(s.velocity[i].spin, truth.velocity[i].spin, 1e-8) << entry.path() << " body " << i;
    }
  }
}

// Disks and clusters, with and without friction, touched by walls at rest and in motion.
TEST(Newton, AgreesWithSweepsOverSteps) {
  const Packing packings[] = {{},
                              {.friction = 0.0},
                              {.periodic = true},
                              {.friction = 0.0, .clusters = true},
                              {.clusters = true},
                              {.restitution = 0.5, .turning_wall = true}};
  for (const Packing& packing : packings) {
    SerialCommunicator serial;
    NewtonOptions newton = To(1e-7);
    NscdOptions sweeps{{.criterion = Criterion::kNatMax, .tolerance = 1e-8, .max_iterations = 3000000}, {}};
    const test::Outcome one = test::Run(packing, {}, newton, 2, &serial), other = test::Run(packing, {}, sweeps, 2, &serial);
    for (const StepReport& report : one.reports) {
      EXPECT_EQ(report.solve.status, SolveStatus::kConverged) << report.solve.reason;
      EXPECT_LE(report.solve.iterations, 400);
      EXPECT_EQ(report.solve.factorisations, report.solve.iterations);
    }
    ASSERT_EQ(other.reports.back().solve.status, SolveStatus::kConverged) << other.reports.back().solve.reason;
    for (std::size_t i = 0; i < one.bodies.size(); ++i) {
      EXPECT_NEAR(one.bodies[i].velocity.vx, other.bodies[i].velocity.vx, 1e-5);
      EXPECT_NEAR(one.bodies[i].velocity.vy, other.bodies[i].velocity.vy, 1e-5);
    }
  }
}

// One contact of three is smooth: it has no tangential pairs.
TEST(Newton, SolvesMixedFriction) {
  ContactProblem p = SampleProblem({.friction = 0.4});
  for (std::size_t c = 0; c < p.contacts.size(); c += 3) p.contacts.friction[c] = 0.0;
  const ContactSolution s = SolveContactProblem(p, To(1e-8));
  EXPECT_EQ(s.report.status, SolveStatus::kConverged) << s.report.reason;
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    EXPECT_LE(std::abs(s.impulse[c].y), p.contacts.friction[c] * s.impulse[c].x * (1.0 + 1e-12));
  }
}

TEST(Newton, OtherFactorisationsGiveTheSameAnswer) {
  const ContactProblem p = SampleProblem({.friction = 0.3});
  NewtonOptions own = To(1e-9), eigen = own;
  eigen.linear_solver = LinearLibrary::kEigen;
  const ContactSolution a = SolveContactProblem(p, own), b = SolveContactProblem(p, eigen);
  EXPECT_EQ(b.report.status, SolveStatus::kConverged);
  for (std::size_t i = 0; i < a.velocity.size(); ++i) EXPECT_NEAR(a.velocity[i].vx, b.velocity[i].vx, 1e-9);
}

TEST(Newton, ALimitIsAStatusWithTheBestIterate) {
  const ContactProblem p = SampleProblem({.friction = 0.8});
  for (int budget = 1; budget <= 25; budget += 4) {
    NewtonOptions o = To(1e-14);
    o.stopping.max_iterations = budget;
    const ContactSolution s = SolveContactProblem(p, o);
    if (s.report.status == SolveStatus::kConverged) continue;
    EXPECT_EQ(s.report.status, SolveStatus::kIterationLimit);
    EXPECT_LE(s.report.iterations, budget);
    double best = INFINITY;
    for (const IterationRecord& record : s.report.history) best = std::min(best, record.nat_max);
    EXPECT_EQ(s.report.residuals.nat_max, best);
  }
}

// Three disks below, two on them and one on top, symmetric: two equal paths, and pairs of contacts that change status at once.
TEST(Newton, SolvesTheSymmetricPyramidThatSlides) {
  const ProblemFile file = ReadProblemFile(std::string(NSCDD_SOURCE_DIR) + "/tests/data/newton_9_contacts.json");
  const ContactSolution s = SolveContactProblem(file.problem, To(1e-8));
  EXPECT_EQ(s.report.status, SolveStatus::kConverged) << s.report.reason;
  EXPECT_LE(s.report.iterations, 40);
}

TEST(Newton, NeverEndsAboveAsManyPlainSweeps) {
  for (const double friction : {0.0, 0.1, 0.8}) {
    const ContactProblem p = SampleProblem({.columns = 4, .rows = 3, .friction = friction});
    for (int budget = 1; budget <= 12; ++budget) {
      NewtonOptions newton = To(1e-12);
      newton.stopping.max_iterations = budget;
      const NscdOptions sweeps{newton.stopping, {.method = Acceleration::kNone}};
      EXPECT_LE(SolveContactProblem(p, newton).report.residuals.nat_max,
                SolveContactProblem(p, sweeps).report.residuals.nat_max)
          << friction << ", " << budget;
    }
  }
}

TEST(Newton, SaysHowImpulsesGrewWhereItStalls) {
  NewtonOptions o = To(1e-30);
  o.stopping.stall_iterations = 60;
  const SolveReport report = SolveContactProblem(SampleProblem({.friction = 0.4}), o).report;
  EXPECT_EQ(report.status, SolveStatus::kStalled);
  EXPECT_NE(report.reason.find("|r|_D"), std::string::npos) << report.reason;
}

// Asked for more than rounding allows, it stalls near rounding and does not run away; also where the solution is no impulse at
// all.
TEST(Newton, StaysWhereRoundingStopsIt) {
  ContactProblem flight = SampleProblem({.friction = 0.4});
  for (double& offset : flight.offset) offset += 1.0;
  for (const ContactProblem& p : {SampleProblem({.friction = 0.4}), SampleProblem({.friction = 0.0}), flight}) {
    NewtonOptions o = To(1e-30);
    o.stopping.stall_iterations = 400;
    const ContactSolution s = SolveContactProblem(p, o);
    EXPECT_NE(s.report.status, SolveStatus::kDiverged) << s.report.reason;
    EXPECT_LT(s.report.residuals.nat_max, 1e-7);
    for (const IterationRecord& record : s.report.history) EXPECT_LT(record.nat_max, 1e3) << "iteration " << record.iteration;
  }
}

// Without loads and approach there is no scale, and nothing to do.
TEST(Newton, WithoutLoadsNothingMoves) {
  ContactProblem p = SampleProblem({});
  for (auto& v : p.free_velocity) v = {};
  for (auto& f : p.impulse) f = {};
  const ContactSolution s = SolveContactProblem(p, To(1e-8));
  EXPECT_EQ(s.report.status, SolveStatus::kConverged) << s.report.reason;
  for (const Vec2& r : s.impulse) EXPECT_EQ(r.x, 0.0);
}

TEST(Newton, RefusesWhatItCannotMeasure) {
  NewtonOptions o;
  o.stopping.criterion = Criterion::kQm16;
  EXPECT_THROW(SolveContactProblem(SampleProblem({}), o), Error);
  EXPECT_THROW(SolveContactProblem(SampleProblem({.subdomains = 2}), To(1e-6)), Error);
}

}  // namespace
}  // namespace nscdd
