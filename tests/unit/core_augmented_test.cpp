// SPDX-License-Identifier: Apache-2.0
// The augmented interface: golden impulses of the pyramid, and its identities.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "algorithms/algorithms.h"
#include "algorithms/stages.h"
#include "interface/augmented_subdomain.h"
#include "nscdd/error.h"
#include "problem/problem_file.h"
#include "problem/state.h"
#include "sample_problem.h"

namespace nscdd {
namespace {

using test::Sample;
using test::SampleProblem;

/// A sample after some iterations of NSCDD and one more sweep: the interface is about to be updated.
struct Halfway {
  Halfway(const ContactProblem& source, int iterations) : sample(source) {
    sample.problem.mean_mass = 0.0;
    double count = 0.0;
    for (const double mass : source.mass) {
      if (std::isinf(mass)) continue;
      sample.problem.mean_mass += mass;
      count += 1.0;
    }
    sample.problem.mean_mass /= count;
    state = InitialState(sample.problem, {});
    AugmentedInterfaceOptions plain;
    plain.lambda = 0.0;
    Stages stages(sample.problem, plain, &serial, &workspace, &state);
    for (int k = 0; k < iterations; ++k) {
      stages.SweepSubdomains(1);
      stages.MeasureJump();
      stages.UpdateInterface();
    }
  }
  /// Sweep and one augmented update.
  void Update(const AugmentedInterfaceOptions& options) {
    Stages stages(sample.problem, options, &serial, &workspace, &state);
    stages.SweepSubdomains(1);
    stages.MeasureJump();
    stages.UpdateInterface();
  }
  Sample sample;
  SerialCommunicator serial;
  InterfaceWorkspace workspace;
  PartitionedState state;
};

struct GoldenUpdate {
  const char* key;
  double lambda;
  Compatibility compatibility;
  LocalVelocity local_velocity;
};

class GoldenInterface : public testing::TestWithParam<GoldenUpdate> {};

TEST_P(GoldenInterface, ImpulseOfThePyramid) {
  const std::string path = std::string(NSCDD_SOURCE_DIR) + "/tests/data/golden/c8_pyramid6.json";
  const auto json = nlohmann::json::parse(std::ifstream(path));
  ProblemFile file = ReadProblemFile(path);
  file.problem.subdomain = json["partition_2x1"].get<std::vector<int>>();
  Halfway halfway(file.problem, 2);
  AugmentedInterfaceOptions o;
  o.lambda = GetParam().lambda;
  o.compatibility = GetParam().compatibility;
  o.local_velocity = GetParam().local_velocity;
  halfway.Update(o);
  const auto& expected = json[GetParam().key];
  const auto& map = halfway.sample.problem.interface;
  ASSERT_EQ(5 * map.copies.size(), expected.size());
  for (std::size_t k = 0; k < map.copies.size(); ++k) {
    const auto& p = halfway.sample.problem.subdomains[map.copies[k].problem];
    ASSERT_EQ(p.body[map.copies[k].body], expected[5 * k].get<int>());
    ASSERT_EQ(p.subdomain, expected[5 * k + 1].get<int>());
    for (int d = 0; d < 3; ++d) {
      EXPECT_NEAR(halfway.state.interface.impulse[3 * k + d], expected[5 * k + 2 + d].get<double>(), 1e-13) << "copy " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Updates, GoldenInterface,
    testing::Values(GoldenUpdate{"enriched_F_L0_Gn_vlocal", 0.0, Compatibility::kNormal, LocalVelocity::kLocal},
                    GoldenUpdate{"enriched_F_L10_Gn_vlocal", 10.0, Compatibility::kNormal, LocalVelocity::kLocal},
                    GoldenUpdate{"enriched_F_L10_Gn_vcurrent", 10.0, Compatibility::kNormal, LocalVelocity::kCurrent},
                    GoldenUpdate{"enriched_F_L10_Gfull_vlocal", 10.0, Compatibility::kFull, LocalVelocity::kLocal},
                    GoldenUpdate{"enriched_F_L10_Gfull_vcurrent", 10.0, Compatibility::kFull, LocalVelocity::kCurrent}),
    [](const auto& update) { return std::string(update.param.key); });

// The conjugate gradient on X_lambda and the assembled primal problem are the same update; impulses sum to zero per body.
TEST(AugmentedInterface, ConjugateGradientIsTheDirectSolve) {
  const ContactProblem source = SampleProblem({.subdomains = 4});
  for (const Compatibility compatibility : {Compatibility::kNormal, Compatibility::kFull, Compatibility::kSticking}) {
    for (const double lambda : {0.1, 10.0, 1e4}) {
      AugmentedInterfaceOptions o;
      o.lambda = lambda;
      o.compatibility = compatibility;
      Halfway direct(source, 3);
      direct.Update(o);
      const std::vector<double>& expected = direct.state.interface.impulse;
      double norm = 0.0;
      std::vector<double> sum(3 * source.mass.size());
      const auto& map = direct.sample.problem.interface;
      for (std::size_t k = 0; k < map.copies.size(); ++k) {
        const int row = direct.sample.problem.subdomains[map.copies[k].problem].body[map.copies[k].body];
        for (int d = 0; d < 3; ++d) {
          norm = std::max(norm, std::abs(expected[3 * k + d]));
          sum[3 * row + d] += expected[3 * k + d];
        }
      }
      for (const double s : sum) EXPECT_NEAR(s, 0.0, 1e-11 * norm);
      for (const Preconditioner preconditioner :
           {Preconditioner::kNone, Preconditioner::kDiagonal, Preconditioner::kLumped, Preconditioner::kDirichlet}) {
        o.solve = InterfaceSolve::kCg;
        o.preconditioner = preconditioner;
        o.cg_tolerance = 1e-13;
        o.cg_max_iterations = 100000;
        Halfway cg(source, 3);
        cg.Update(o);
        double error = 0.0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          error = std::max(error, std::abs(cg.state.interface.impulse[i] - expected[i]));
        }
        // Every body is on this interface; at 1e4 the weak preconditioners stagnate at their attainable accuracy.
        const bool weak = preconditioner == Preconditioner::kNone || preconditioner == Preconditioner::kDiagonal;
        EXPECT_LT(error, (weak && lambda > 1e3 ? 1e-5 : 1e-9) * norm)
            << "lambda " << lambda << ", compatibility " << static_cast<int>(compatibility) << ", preconditioner "
            << static_cast<int>(preconditioner);
        o.solve = InterfaceSolve::kDirect;
      }
    }
  }
}

// The velocities of prescribed bodies are known to both solves.
TEST(AugmentedInterface, MovingWallsEnterTheUpdate) {
  ContactProblem source = SampleProblem({.subdomains = 4});
  source.free_velocity.back() = {0.3, 0.2, 0.0};  // the wall
  AugmentedInterfaceOptions o;
  o.compatibility = Compatibility::kFull;
  o.cg_tolerance = 1e-13;
  o.cg_max_iterations = 100000;
  Halfway direct(source, 3), cg(source, 3);
  direct.Update(o);
  o.solve = InterfaceSolve::kCg;
  cg.Update(o);
  const std::vector<double>&expected = direct.state.interface.impulse, &found = cg.state.interface.impulse;
  double norm = 0.0;
  for (const double f : expected) norm = std::max(norm, std::abs(f));
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9 * norm);
}

// lambda / W_nn of whole masses, whatever the multiplicities: the diagonal of M~ + Lambda G G^T from the contact table.
TEST(AugmentedInterface, ContactsAreWeightedByWholeMasses) {
  const ContactProblem source = SampleProblem({.subdomains = 4});
  const Sample sample(source);
  AugmentedInterfaceOptions o;
  o.lambda = 3.0;
  o.lambda_scale = LambdaScale::kContact;
  for (const SubdomainProblem& p : sample.problem.subdomains) {
    AugmentedSubdomain part(p, o, 1.0);
    SubdomainState state;
    state.impulse.assign(2 * p.contact_count(), 1.0);
    part.ChooseColumns(state);
    std::vector<double> expected;
    for (int i = 0; i < part.nodes(); ++i) {
      const int row = p.body[part.CopyOf(i)];
      double x = source.mass[row] / sample.sharing.Multiplicity(row), y = x;
      for (const std::int32_t c : p.contact) {
        const int a = source.contacts.a[c], b = source.contacts.b[c];
        if (a != row && b != row) continue;
        const double weight = 3.0 / (sample.inverse_mass[a] + sample.inverse_mass[b]);
        x += weight * source.contacts.normal[c].x * source.contacts.normal[c].x;
        y += weight * source.contacts.normal[c].y * source.contacts.normal[c].y;
      }
      expected.insert(expected.end(), {x, y});
    }
    const std::vector<double> diagonal = part.Diagonal();
    ASSERT_EQ(diagonal.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(diagonal[i], expected[i], 1e-12 * expected[i]);
  }
}

// At a small lambda each preconditioner costs more than the one before and saves iterations.
TEST(AugmentedInterface, PreconditionersSaveIterations) {
  ContactProblem blocks = SampleProblem({.columns = 16, .rows = 16, .subdomains = 4});
  for (std::size_t c = 0; c < blocks.subdomain.size(); ++c) {
    const int body = blocks.contacts.a[c] < 256 ? blocks.contacts.a[c] : blocks.contacts.b[c];
    blocks.subdomain[c] = body % 16 / 8 + 2 * (body / 128);
  }
  std::vector<std::int64_t> iterations;
  for (const Preconditioner preconditioner :
       {Preconditioner::kNone, Preconditioner::kDiagonal, Preconditioner::kLumped, Preconditioner::kDirichlet}) {
    FeaOptions fea;
    fea.stopping.tolerance = 0.0;
    fea.stopping.max_iterations = 10;
    fea.acceleration.method = Acceleration::kNone;
    fea.interface.lambda = 1.0;
    fea.interface.solve = InterfaceSolve::kCg;
    fea.interface.preconditioner = preconditioner;
    fea.interface.cg_tolerance = 1e-8;
    iterations.push_back(SolveContactProblem(blocks, fea).report.cg_iterations);
  }
  for (std::size_t i = 1; i < iterations.size(); ++i) EXPECT_LT(iterations[i], iterations[i - 1]) << "preconditioner " << i;
}

// lambda = 0 is NSCDD, bit for bit, and builds no matrix.
TEST(AugmentedInterface, LambdaZeroIsNscdd) {
  const ContactProblem source = SampleProblem({.subdomains = 4});
  NscddOptions nscdd;
  nscdd.sweeps_per_stage = 2;
  FeaOptions fea;
  fea.sweeps_per_stage = 2;
  fea.interface.lambda = 0.0;
  const ContactSolution a = SolveContactProblem(source, nscdd), b = SolveContactProblem(source, fea);
  EXPECT_EQ(a.report.iterations, b.report.iterations);
  EXPECT_EQ(b.report.factorisations, 0);
  for (std::size_t i = 0; i < a.velocity.size(); ++i) {
    EXPECT_EQ(a.velocity[i].vx, b.velocity[i].vx);
    EXPECT_EQ(a.velocity[i].spin, b.velocity[i].spin);
  }
}

// FEA's limit is NSCD's, for every compatibility and both interface solves, where it converges.
TEST(AugmentedInterface, FeaHasTheLimitOfNscd) {
  const ContactProblem source = SampleProblem({.friction = 0.0, .subdomains = 3});
  ContactProblem whole = source;
  whole.subdomain.clear();
  NscdOptions nscd;
  nscd.stopping.tolerance = 1e-11;
  nscd.stopping.max_iterations = 100000;
  const ContactSolution expected = SolveContactProblem(whole, nscd);
  FeaOptions fea;
  fea.stopping = nscd.stopping;
  for (const InterfaceSolve solve : {InterfaceSolve::kDirect, InterfaceSolve::kCg}) {
    for (const LambdaScale scale : {LambdaScale::kMass, LambdaScale::kContact}) {
      fea.interface.solve = solve;
      fea.interface.lambda_scale = scale;
      const ContactSolution s = SolveContactProblem(source, fea);
      ASSERT_EQ(s.report.status, SolveStatus::kConverged) << s.report.reason;
      EXPECT_GT(s.report.factorisations, 0);
      EXPECT_EQ(s.report.cg_iterations > 0, solve == InterfaceSolve::kCg);
      for (std::size_t i = 0; i < s.velocity.size(); ++i) EXPECT_NEAR(s.velocity[i].vy, expected.velocity[i].vy, 1e-8);
    }
  }
}

// IEA is REA with one interface update.
TEST(AugmentedInterface, IeaIsReaWithOneUpdate) {
  const ContactProblem source = SampleProblem({.subdomains = 3});
  ReaOptions rea;
  rea.sweeps_per_stage = 1;
  rea.max_interface_updates = 1;
  IeaOptions iea;
  iea.interface.lambda = rea.interface.lambda = 100.0;
  const ContactSolution a = SolveContactProblem(source, rea), b = SolveContactProblem(source, iea);
  EXPECT_EQ(a.report.interface_updates, 1);
  EXPECT_EQ(b.report.interface_updates, 1);
  EXPECT_EQ(a.report.iterations, b.report.iterations + 1);
  for (std::size_t i = 0; i < a.velocity.size(); ++i) {
    EXPECT_EQ(a.velocity[i].vx, b.velocity[i].vx);
    EXPECT_EQ(a.velocity[i].vy, b.velocity[i].vy);
  }
}

// What cannot work says so and never returns a number that is none.
TEST(AugmentedInterface, DivergenceIsAStatusAndKeepsAGoodIterate) {
  const ContactProblem source = SampleProblem({.columns = 12, .rows = 12, .friction = 0.0, .subdomains = 6});
  FeaOptions fea;
  fea.sweeps_per_stage = 1;
  fea.interface.local_velocity = LocalVelocity::kCurrent;
  fea.interface.lambda = 1e6;
  fea.stopping.max_iterations = 3000;
  fea.acceleration.method = Acceleration::kNone;
  fea.jump_guard = false;
  const ContactSolution s = SolveContactProblem(source, fea);
  EXPECT_NE(s.report.status, SolveStatus::kConverged);
  for (const Twist& v : s.velocity) EXPECT_TRUE(std::isfinite(v.vx + v.vy + v.spin));
  for (const IterationRecord& record : s.report.history) EXPECT_FALSE(record.nat < s.report.residuals.nat);
  fea.interface.lambda = 1e12;
  EXPECT_THROW(SolveContactProblem(source, fea), Error);
}

// The relative residual of impulses that run away stays near 1; the worst contact tells, and nothing of it is returned.
TEST(AugmentedInterface, ReaThatRunsAwayHasDiverged) {
  const ContactProblem source = SampleProblem({.columns = 12, .rows = 12, .friction = 0.0, .subdomains = 6});
  ReaOptions rea;
  rea.sweeps_per_stage = 1;
  rea.interface.local_velocity = LocalVelocity::kCurrent;
  rea.interface.compatibility = Compatibility::kFull;
  rea.interface.lambda = 1e4;
  rea.max_interface_updates = 2000;
  const ContactSolution s = SolveContactProblem(source, rea);
  EXPECT_EQ(s.report.status, SolveStatus::kDiverged) << s.report.reason;
  EXPECT_LT(s.report.interface_updates, 2000);
  for (const Vec2& r : s.impulse) EXPECT_EQ(r.x, 0.0);
  rea.interface.lambda = 1.0;
  EXPECT_NE(SolveContactProblem(source, rea).report.status, SolveStatus::kDiverged);
}

}  // namespace
}  // namespace nscdd
