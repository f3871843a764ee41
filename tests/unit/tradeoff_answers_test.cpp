// SPDX-License-Identifier: Apache-2.0
// The yardstick of answers, beside closed forms and beside what the core says of its own answers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nscdd/contact_problem.h"
#include "nscdd/error.h"
#include "nscdd/interpenetration.h"
#include "nscdd/reference/reference_adapter.h"
#include "sample_problem.h"
#include "tradeoff/plan.h"

namespace nscdd {
namespace {

constexpr double kG = 9.81, kDt = 0.01;

/// A unit disk of 2 kg, `gap` above the ground, that falls with `speed` and slides with `slide`.
class Ground {
 public:
  explicit Ground(double gap, double speed = 0.0, double slide = 0.0) : adapter_(&world_) {
    world_.gravity = {0.0, -kG};
    reference::Body ground = reference::MakeWall(0);
    ground.half_planes = {{{0.0, 1.0}, 0.0}};
    ground.friction = 0.5;
    world_.Add(ground);
    reference::Body disk = reference::MakeDisk(7, {0.0, 1.0 + gap}, 1.0, 1.0);
    disk.mass = 2.0;
    disk.inertia = 1.0;
    disk.friction = 0.5;
    disk.velocity = {slide, -speed, 0.0};
    world_.Add(disk);
  }
  StepProblem Read() {
    SteppingOptions stepping;
    stepping.alert_distance = 0.2;
    return ReadStepProblem(&adapter_, stepping, kDt);
  }
  PlatformAdapter* adapter() { return &adapter_; }

 private:
  reference::World world_;
  reference::ReferenceAdapter adapter_;
};

TEST(StepProblem, ReadsFreeVelocityOffsetAndKeys) {
  const StepProblem p = Ground(0.01, 1.0).Read();
  ASSERT_EQ(p.keys.size(), 1u);
  EXPECT_EQ(p.keys[0], (ContactKey{0, 7, 0, 0, 0}));
  EXPECT_NEAR(p.problem.contacts.gap[0], 0.005, 1e-15);  // at q + dt V / 2
  EXPECT_NEAR(p.problem.offset[0], 0.5, 1e-12);          // gap / dt
  EXPECT_NEAR(p.problem.free_velocity[1].vy, -1.0 - kG * kDt, 1e-15);
  EXPECT_EQ(p.problem.approach_speed, 1.0);
  EXPECT_TRUE(std::isinf(p.problem.mass[0]));
}

TEST(StepProblem, RefusesWhatItCannotRead) {
  Ground ground(0.0);
  SteppingOptions stepping;
  EXPECT_THROW(ReadStepProblem(ground.adapter(), stepping, kDt), Error);
  stepping.alert_distance = 0.1;
  stepping.normal_law = NormalLaw::kStrict;
  EXPECT_THROW(ReadStepProblem(ground.adapter(), stepping, kDt), Error);
}

TEST(Answers, RestIsExact) {
  const StepProblem p = Ground(0.0).Read();
  const AnswerResiduals r = MeasureAnswer(p.problem, {{{}, {}}, {{2.0 * kG * kDt, 0.0}}});
  EXPECT_NEAR(r.nat, 0.0, 1e-14);
  EXPECT_NEAR(r.nat_max, 0.0, 1e-14);
  EXPECT_NEAR(r.momentum_defect, 0.0, 1e-14);
  EXPECT_NEAR(r.energy_defect, 0.0, 1e-14);
}

TEST(Answers, FreeFallThroughTheGround) {
  const StepProblem p = Ground(0.0).Read();
  const AnswerResiduals r = MeasureAnswer(p.problem, {{{}, {0.0, -kG * kDt, 0.0}}, {{}}});
  EXPECT_NEAR(r.nat_max, 1.0, 1e-14);
  EXPECT_NEAR(r.momentum_defect, 0.0, 1e-14);
  // e = rho v_n with rho = 1 / max(W_nn, W_tt), over 1e-3 |dt f|
  EXPECT_NEAR(r.nat, kG * kDt / 1.5 / (1e-3 * 2.0 * kG * kDt), 1e-9);
}

TEST(Answers, DefectsHaveTheirSigns) {
  const StepProblem p = Ground(0.0, 0.0, 1.0).Read();
  const double rn = 2.0 * kG * kDt, energy = 2.0 * kG * kG * kDt * kDt;
  // Half the friction that sliding asks for: the contact takes too little energy.
  Answer weak{{{}, {1.0 - 0.25 * rn / 2.0, 0.0, 0.0}}, {{rn, -0.25 * rn}}};
  weak.velocity[1].spin = -0.25 * rn * 1.0 / 1.0;
  EXPECT_GT(MeasureAnswer(p.problem, weak).energy_defect, 0.0);
  // An impulse while the contact closes: it takes too much.
  const ContactProblem still = Ground(0.0).Read().problem;
  const Answer closing{{{}, {0.0, -0.01, 0.0}}, {{rn, 0.0}}};
  EXPECT_NEAR(MeasureAnswer(still, closing).energy_defect, -0.01 * rn / energy, 1e-9);
  EXPECT_NEAR(MeasureAnswer(still, closing).momentum_defect, 0.01 / (kG * kDt), 1e-9);
}

/// Also without friction, where the cone is a half-line, and where only some contacts count.
TEST(Answers, AgreeWithTheCore) {
  for (const double friction : {0.3, 0.0}) {
    const ContactProblem problem = test::SampleProblem({.friction = friction});
    for (const int sweeps : {1, 5, 40}) {
      NscdOptions options;
      options.stopping.tolerance = 0.0;
      options.stopping.max_iterations = options.stopping.test_every = sweeps;
      const ContactSolution solution = SolveContactProblem(problem, options);
      const Answer answer{solution.velocity, solution.impulse};
      const AnswerResiduals r = MeasureAnswer(problem, answer);
      EXPECT_NEAR(r.nat, solution.report.residuals.nat, 1e-10 * r.nat) << friction << " " << sweeps;
      EXPECT_NEAR(r.nat_max, solution.report.residuals.nat_max, 1e-10 * r.nat_max);
      EXPECT_LT(r.momentum_defect, 1e-12);
      EXPECT_EQ(MeasureAnswer(problem, answer, std::vector<bool>(problem.contacts.size(), false)).nat, 0.0);
    }
  }
}

/// Warm impulses of the whole are a fixed point of every decomposition: its interface impulses follow from them.
TEST(Answers, WarmSolutionIsAFixedPointOfTheDecomposition) {
  const ContactProblem whole = test::SampleProblem({.subdomains = 4});
  ContactProblem one = whole;
  one.subdomain.clear();
  NscdOptions exact;
  exact.stopping.tolerance = 1e-13;
  exact.stopping.max_iterations = 200000;
  const ContactSolution solution = SolveContactProblem(one, exact);
  ASSERT_EQ(solution.report.status, SolveStatus::kConverged);
  NscddOptions once;
  once.stopping.tolerance = 0.0;
  once.stopping.max_iterations = 1;
  EXPECT_LT(SolveContactProblem(whole, once, solution.impulse).report.residuals.nat, 1e-12);
}

TEST(Answers, VelocityErrorIsInUnitsOfTheLoads) {
  const StepProblem p = Ground(0.0).Read();
  const VelocityError e = CompareVelocities(p.problem, {{}, {0.0, -kG * kDt, 0.0}}, {{}, {}});
  EXPECT_NEAR(e.energy_norm, 1.0, 1e-14);
  EXPECT_NEAR(e.worst_body, 1.0, 1e-14);
  const VelocityError spin = CompareVelocities(p.problem, {{}, {0.0, 0.0, kG * kDt}}, {{}, {}});
  EXPECT_NEAR(spin.energy_norm, std::sqrt(0.5), 1e-14);  // I / m = 1/2
}

TEST(Growth, ASolverThatIgnoresTheGroundIsTheSolversPart) {
  Ground ground(0.0, 1.0);
  const StepProblem p = ground.Read();  // gap at q_m: -dt / 2
  const std::vector<Twist> velocity = {{}, {0.0, -1.0, 0.0}};
  const auto end = Drifted(p.detection, velocity, 0.5 * kDt, ground.adapter()->Describe());
  const InterpenetrationGrowth g = MeasureGrowth(ground.adapter(), p, velocity, end);
  EXPECT_NEAR(g.solver_max, kDt, 1e-12);
  EXPECT_NEAR(g.solver_mean, kDt, 1e-12);
  EXPECT_NEAR(g.geometry_mean, 0.0, 1e-12);  // a plane is its own linearisation
  EXPECT_NEAR(MeasureInterpenetration(ground.adapter(), p.bodies.id, end, 0.2).max, kDt, 1e-12);
}

TEST(Growth, WhatVelocitiesDoNotExplainIsGeometry) {
  Ground ground(0.0);
  const StepProblem p = ground.Read();
  const std::vector<Twist> rest(2);
  std::vector<Pose> end = p.detection;
  end[1].y -= 1e-3;  // moved without a velocity
  const InterpenetrationGrowth g = MeasureGrowth(ground.adapter(), p, rest, end);
  EXPECT_EQ(g.solver_max, 0.0);
  EXPECT_NEAR(g.geometry_max, 1e-3, 1e-12);
  end[1].y += 2e-3;
  EXPECT_EQ(MeasureGrowth(ground.adapter(), p, rest, end).geometry_max, 0.0);
}

TEST(Observables, OfARestingDisk) {
  const StepProblem p = Ground(0.0, 0.0, 3.0).Read();
  const Answer answer{{{}, {3.0, 0.0, 2.0}}, {{2.0 * kG * kDt, 0.0}}};
  const std::vector<Pose> end = {{}, {0.5, 1.0, 0.0}};
  EXPECT_EQ(Evaluate(Observable::kCentreOfMassX, p, answer, end, 0.0), 0.5);
  EXPECT_EQ(Evaluate(Observable::kCentreOfMassY, p, answer, end, 0.0), 1.0);
  EXPECT_EQ(Evaluate(Observable::kKineticEnergy, p, answer, end, 0.0), 9.0 + 2.0);
  EXPECT_NEAR(Evaluate(Observable::kWallForce, p, answer, end, 0.0), 2.0 * kG, 1e-12);
  EXPECT_NEAR(Evaluate(Observable::kWallForceY, p, answer, end, 0.0), -2.0 * kG, 1e-12);
  EXPECT_EQ(Evaluate(Observable::kFlowRate, p, answer, end, 12.0), 0.5);
  for (const std::string& name : ObservableNames()) EXPECT_EQ(NameOf(ParseObservable(name)), name);
  EXPECT_THROW(ParseObservable("weight"), Error);
}

TEST(Settings, NamesAreUniqueAndBothListsHaveEverySolver) {
  const std::vector<Setting> all = DefaultSettings();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(all[i].name, all[j].name);
  }
  for (const std::string solver : {"nscd", "nscdd", "fea", "iea", "newton", "box2d"}) {
    const auto quick = [&](const Setting& s) { return s.solver == solver && s.quick; };
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), quick)) << solver;
  }
}

TEST(Settings, WithoutAPluginNothingIsKnownButBox2d) {
  std::vector<std::string> notices;
  const std::vector<Setting> known = KnownSettings(DefaultSettings(), SolverRegistry(), &notices);
  EXPECT_TRUE(std::all_of(known.begin(), known.end(), [](const Setting& s) { return s.is_box2d(); }));
  EXPECT_EQ(notices.size(), 5u);  // a line for each solver that is not there
}

}  // namespace
}  // namespace nscdd
