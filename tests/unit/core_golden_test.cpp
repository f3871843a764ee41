// SPDX-License-Identifier: Apache-2.0
// Solved contact problems (tests/data/golden): the steps' solutions to 1e-12 in SI units.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "interface/gluing.h"
#include "nscdd/contact_problem.h"
#include "problem/problem_file.h"

namespace nscdd {
namespace {

using Json = nlohmann::json;

std::string PathOf(const std::string& name) { return std::string(NSCDD_SOURCE_DIR) + "/tests/data/golden/" + name + ".json"; }
Json ReadJson(const std::string& name) { return Json::parse(std::ifstream(PathOf(name))); }

NscdOptions Tight() {
  NscdOptions o;
  o.stopping.tolerance = 1e-14;
  o.stopping.max_iterations = 1000000;
  return o;
}

void ExpectVelocities(const Json& expected, const std::vector<Twist>& velocity) {
  for (std::size_t i = 0; 3 * i < expected.size(); ++i) {
    EXPECT_NEAR(velocity[i].vx, expected[3 * i].get<double>(), 1e-12) << "body " << i;
    EXPECT_NEAR(velocity[i].vy, expected[3 * i + 1].get<double>(), 1e-12) << "body " << i;
    EXPECT_NEAR(velocity[i].spin, expected[3 * i + 2].get<double>(), 1e-12) << "body " << i;
  }
}

NscdOptions TightAndPlain() {
  NscdOptions o = Tight();
  o.acceleration.method = Acceleration::kNone;
  return o;
}

class Golden : public testing::TestWithParam<const char*> {};

TEST_P(Golden, NscdReachesTheStoredVelocities) {
  const Json json = ReadJson(GetParam());
  const ProblemFile file = ReadProblemFile(PathOf(GetParam()));
  for (const NscdOptions& options : {Tight(), TightAndPlain()}) {
    const ContactSolution s = SolveContactProblem(file.problem, options);
    EXPECT_EQ(s.report.status, SolveStatus::kConverged) << s.report.reason;
    ExpectVelocities(json["V_end"], s.velocity);
    if (!json["reactions_unique"].get<bool>()) continue;
    for (std::size_t c = 0; c < s.impulse.size(); ++c) {
      EXPECT_NEAR(s.impulse[c].x, json["contacts"][c][8].get<double>(), 1e-12);
      EXPECT_NEAR(s.impulse[c].y, json["contacts"][c][9].get<double>(), 1e-12);
    }
  }
}

TEST_P(Golden, NscddOnOneSubdomainIsNscdBitForBit) {
  const ProblemFile file = ReadProblemFile(PathOf(GetParam()));
  NscddOptions nscdd;
  nscdd.stopping = Tight().stopping;
  const ContactSolution one = SolveContactProblem(file.problem, Tight()), other = SolveContactProblem(file.problem, nscdd);
  EXPECT_EQ(one.report.iterations, other.report.iterations);
  for (std::size_t i = 0; i < one.velocity.size(); ++i) {
    EXPECT_EQ(one.velocity[i].vx, other.velocity[i].vx);
    EXPECT_EQ(one.velocity[i].vy, other.velocity[i].vy);
    EXPECT_EQ(one.velocity[i].spin, other.velocity[i].spin);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden,
                         testing::Values("c1_rest_on_plane", "c2_incline_slide", "c3_incline_roll", "c4_column4",
                                         "c5_oblique_impact", "c6_oblique_impact_e05", "c7_vgroove", "c8_pyramid6"));

TEST(GoldenPyramid, NscddReachesTheSameVelocities) {
  const Json json = ReadJson("c8_pyramid6");
  ProblemFile file = ReadProblemFile(PathOf("c8_pyramid6"));
  file.problem.subdomain = json["partition_2x1"].get<std::vector<int>>();
  NscddOptions o;
  o.stopping = Tight().stopping;
  o.stopping.tolerance = 1e-13;
  const ContactSolution s = SolveContactProblem(file.problem, o);
  EXPECT_EQ(s.report.status, SolveStatus::kConverged) << s.report.reason;
  ExpectVelocities(json["V_end"], s.velocity);
}

// Iterations 1 to 3 of NSCDD from a cold start: impulses after the sweep, jump before the mean.
TEST(GoldenPyramid, NscddTrace) {
  const Json json = ReadJson("c8_pyramid6");
  ProblemFile file = ReadProblemFile(PathOf("c8_pyramid6"));
  file.problem.subdomain = json["partition_2x1"].get<std::vector<int>>();
  for (int k = 1; k <= 3; ++k) {
    NscddOptions o;
    o.stopping.tolerance = 1e-300;
    o.stopping.max_iterations = k;
    o.stopping.test_every = 1;
    o.acceleration.method = Acceleration::kNone;
    const ContactSolution s = SolveContactProblem(file.problem, o);
    EXPECT_EQ(s.report.status, SolveStatus::kIterationLimit);
    const Json& r = json["nscdd_r_after_sweep_" + std::to_string(k)];
    for (std::size_t c = 0; c < s.impulse.size(); ++c) {
      EXPECT_NEAR(s.impulse[c].x, r[2 * c].get<double>(), 1e-14) << "iteration " << k << " contact " << c;
      EXPECT_NEAR(s.impulse[c].y, r[2 * c + 1].get<double>(), 1e-14) << "iteration " << k << " contact " << c;
    }
    EXPECT_NEAR(s.report.residuals.interface_jump, json["nscdd_jump_before_update_" + std::to_string(k)].get<double>(), 1e-14);
  }
}

}  // namespace
}  // namespace nscdd
