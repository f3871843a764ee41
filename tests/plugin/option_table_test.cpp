// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "expect_error.h"
#include "option_text.h"
#include "solver_infos.h"
#include "text/nearest_name.h"

namespace nscdd {
namespace {

SolverSettings Set(const std::string& solver, const OptionTexts& texts) { return MakeSettings(FindSolver(solver), texts); }

const NscdOptions& Nscd(const SolverSettings& s) { return std::get<NscdOptions>(s.algorithm); }
const NscddOptions& Nscdd(const SolverSettings& s) { return std::get<NscddOptions>(s.algorithm); }

TEST(OptionTable, DefaultsAreThoseOfTheStructs) {
  const SolverSettings s = Set("nscdd", {});
  EXPECT_EQ(s.stepping.theta, SteppingOptions{}.theta);
  EXPECT_EQ(Nscdd(s).stopping.tolerance, StoppingOptions{}.tolerance);
  EXPECT_EQ(Nscdd(s).partition.nx, PartitionOptions{}.nx);
}

TEST(OptionTable, PrintsDefaultsThatItAcceptsAgain) {
  for (const SolverEntry& solver : SolverTable()) {
    for (const Option& option : solver.options) {
      SolverSettings settings = solver.defaults;
      const OptionValue value = option.get(settings);
      const std::string text = TextOf(option, value);
      EXPECT_NO_THROW(option.set(ParseOption(option, text, value), &settings))
          << solver.name << " " << option.name << " = " << text;
      EXPECT_EQ(TextOf(option, option.get(settings)), text) << solver.name << " " << option.name;
    }
  }
}

TEST(OptionTable, SetsEveryMember) {
  const SolverSettings s = Set("nscdd", {{"tolerance", "1e-7"},
                                         {"criterion", "qm16"},
                                         {"max_iterations", "12"},
                                         {"test_every", "3"},
                                         {"stall_iterations", "44"},
                                         {"theta", "0.75"},
                                         {"alert_distance", "0.25"},
                                         {"normal_law", "feedback"},
                                         {"feedback_beta", "0.1"},
                                         {"feedback_slop", "0.001"},
                                         {"feedback_cap", "2.5"},
                                         {"warm_start", "false"},
                                         {"subdomains", "4x2"},
                                         {"repartition_every", "7"},
                                         {"sweeps_per_stage", "5"}});
  const NscddOptions& o = Nscdd(s);
  EXPECT_EQ(o.stopping.tolerance, 1e-7);
  EXPECT_EQ(o.stopping.criterion, Criterion::kQm16);
  EXPECT_EQ(o.stopping.max_iterations, 12);
  EXPECT_EQ(o.stopping.test_every, 3);
  EXPECT_EQ(o.stopping.stall_iterations, 44);
  EXPECT_EQ(s.stepping.theta, 0.75);
  EXPECT_EQ(s.stepping.alert_distance, 0.25);
  EXPECT_EQ(s.stepping.normal_law, NormalLaw::kFeedback);
  EXPECT_EQ(s.stepping.feedback_beta, 0.1);
  EXPECT_EQ(s.stepping.feedback_slop, 0.001);
  EXPECT_EQ(s.stepping.feedback_cap, 2.5);
  EXPECT_FALSE(s.stepping.warm_start);
  EXPECT_EQ(o.partition.nx, 4);
  EXPECT_EQ(o.partition.ny, 2);
  EXPECT_EQ(o.partition.repartition_every, 7);
  EXPECT_EQ(o.sweeps_per_stage, 5);
}

TEST(OptionTable, NamesEveryEnumerator) {
  const std::pair<const char*, Criterion> criteria[] = {{"nat", Criterion::kNat},
                                                        {"nat_max", Criterion::kNatMax},
                                                        {"quad", Criterion::kQuad},
                                                        {"maxm", Criterion::kMaxm},
                                                        {"qm16", Criterion::kQm16}};
  for (const auto& [name, value] : criteria)
    EXPECT_EQ(Nscd(Set("nscd", {{"criterion", name}})).stopping.criterion, value) << name;
  const std::pair<const char*, NormalLaw> laws[] = {
      {"gap", NormalLaw::kGap}, {"strict", NormalLaw::kStrict}, {"feedback", NormalLaw::kFeedback}};
  for (const auto& [name, value] : laws) EXPECT_EQ(Set("nscd", {{"normal_law", name}}).stepping.normal_law, value) << name;
}

TEST(OptionTable, RefusesUnknownNamesAndSuggests) {
  ExpectError([] { Set("nscd", {{"tolerence", "1"}}); }, {"no option 'tolerence'", "did you mean 'tolerance'?"});
  ExpectError([] { Set("nscd", {{"zzz", "1"}}); }, {"no option 'zzz'", "it has tolerance, criterion"});
  ExpectError([] { Set("nscd", {{"subdomains", "2x2"}}); }, {"'nscd' has no option 'subdomains'", "solver 'nscdd'"});
  ExpectError([] { FindSolver("nscddd"); }, {"no solver 'nscddd'", "did you mean 'nscdd'?"});
  ExpectError([] { Set("nscd", {{"theta", "0.5"}, {"theta", "0.6"}}); }, {"'theta' is given twice"});
}

TEST(OptionTable, RefusesWrongValues) {
  for (const char* text : {"", "abc", "nan", "inf", "-1", "1e-4x", " 1", "0x10", "1,5"}) {
    ExpectError([&] { Set("nscd", {{"tolerance", text}}); }, {"option 'tolerance' is '" + std::string(text) + "'", ">= 0"});
  }
  for (const char* text : {"0", "-3", "2.5", "1e3", "99999999999", "ten", ""}) {
    ExpectError([&] { Set("nscd", {{"max_iterations", text}}); }, {"option 'max_iterations'", "whole number >= 1"});
  }
  for (const char* text : {"2", "2x", "x2", "0x2", "2x0", "-1x2", "2x2x2", "2X2", "1000001x1", "1001x1000", "100000x100000"}) {
    ExpectError([&] { Set("nscdd", {{"subdomains", text}}); }, {"option 'subdomains'", "4x2"});
  }
  ExpectError([] { Set("nscd", {{"theta", "0.4"}}); }, {"'theta' is '0.4'", ">= 0.5 and <= 1"});
  ExpectError([] { Set("nscd", {{"warm_start", "yes"}}); }, {"true or false"});
  ExpectError([] { Set("nscd", {{"criterion", "natmax"}}); }, {"nat, nat_max, quad, maxm, qm16", "did you mean 'nat_max'?"});
}

TEST(OptionTable, LimitsAreThoseOfTheCore) {
  EXPECT_EQ(Nscdd(Set("nscdd", {{"subdomains", "1000x1000"}})).partition.nx, 1000);
  for (const char* text : {"0", "1"}) {
    ExpectError(
        [&] {
          Set("fea", {{"cg_tolerance", text}});
        },
        {"'cg_tolerance' is '" + std::string(text) + "'", "> 0 and < 1"});
  }
  ExpectError([] { Set("newton", {{"criterion", "quad"}}); }, {"'criterion' of solver 'newton'", "nat_max"});
}

// Each number just outside its limits, straight into the settings and as text: the core refuses both with the same demand.
TEST(OptionTable, TextAndSettingsAreJudgedAlike) {
  int checked = 0;
  for (const SolverEntry& solver : SolverTable()) {
    for (const Option& option : solver.options) {
      SolverSettings settings = solver.defaults;
      OptionValue value = option.get(settings);
      if (auto* number = std::get_if<int>(&value))
        *number = static_cast<int>(option.limits.least) - 1;
      else if (auto* real = std::get_if<double>(&value); real != nullptr && option.limits.least > -1e308)
        *real = option.limits.least - 1.0;
      else
        continue;
      ++checked;
      option.set(value, &settings);
      const std::vector<std::string> parts = {"option '" + option.name + "' is '" + TextOf(option, value) + "'",
                                              MustBe(option, value)};
      ExpectError([&] { CheckSettings(settings); }, parts);
      ExpectError([&] { Set(solver.name, {{option.name, TextOf(option, value)}}); }, parts);
    }
  }
  EXPECT_GT(checked, 60);
}

TEST(OptionTable, MirrorsTheTableForC) {
  ASSERT_EQ(SolverInfos().size(), SolverTable().size());
  const nscdd_solver_info& nscd = SolverInfos()[0];
  EXPECT_STREQ(nscd.name, "nscd");
  ASSERT_EQ(nscd.option_count, SolverTable()[0].options.size());
  EXPECT_STREQ(nscd.options[0].name, "tolerance");
  EXPECT_STREQ(nscd.options[0].default_value, "0.0001");
  EXPECT_STREQ(nscd.options[1].choices, "nat|nat_max|quad|maxm|qm16");
}

TEST(Nearest, CountsEdits) {
  const std::vector<std::string> names = {"alpha", "beta"};
  EXPECT_EQ(NearestName("alhpa", names), "alpha");
  EXPECT_EQ(NearestName("bet", names), "beta");
  EXPECT_EQ(NearestName("completely different", names), "");
  EXPECT_EQ(NearestName(std::string(1 << 20, 'x'), names), "");
}

}  // namespace
}  // namespace nscdd
