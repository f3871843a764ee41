// SPDX-License-Identifier: Apache-2.0
// Ranking, choosing and telling, on rows made up here.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tradeoff/plan.h"
#include "tradeoff/tradeoff_output.h"
#include "tradeoff/tradeoff_row.h"

namespace nscdd {
namespace {

TradeoffRow Row(const std::string& name, double seconds, double nat, double depth, const std::string& solver = "nscd") {
  TradeoffRow row;
  row.view = "runs";
  row.setting = {name, solver, {{"tolerance", "1e-3"}}};
  row.status = "converged";
  row.seconds = seconds;
  row.nat = nat;
  row.interpenetration_max = depth;
  row.steps = 10;
  return row;
}

std::vector<TradeoffRow> Rows() {
  return {Row("good", 4e-3, 2e-5, 1e-4), Row("fast", 1e-3, 3e-2, 5e-3), Row("beaten", 5e-3, 3e-5, 2e-4),
          Row("middle", 2e-3, 8e-4, 3e-3), Row("Box2D 8/3", 1.5e-3, 1e-2, 6e-3, "box2d")};
}

TEST(Front, KeepsWhatNoOtherBeats) {
  EXPECT_EQ(ParetoFront(Rows(), Accuracy::kNat), (std::vector<std::size_t>{1, 4, 3, 0}));
  EXPECT_EQ(ParetoFront(Rows(), Accuracy::kInterpenetration), (std::vector<std::size_t>{1, 3, 0}));
}

TEST(Front, LeavesOutWhatIsUnsoundOrUnmeasured) {
  for (const std::string status : {"failed", "cut", "diverged"}) {
    std::vector<TradeoffRow> rows = Rows();
    rows[0].status = status;
    EXPECT_EQ(ParetoFront(rows, Accuracy::kNat), (std::vector<std::size_t>{1, 4, 3, 2})) << status;
  }
  std::vector<TradeoffRow> rows = Rows();
  rows[0].nat = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ParetoFront(rows, Accuracy::kNat).back(), 2u);
  EXPECT_TRUE(ParetoFront(rows, Accuracy::kVelocityError).empty());  // -1: not measured in this view
}

TEST(Front, OfEqualSecondsTheMoreAccurateCounts) {
  const std::vector<TradeoffRow> rows = {Row("a", 1e-3, 1e-2, 0.0), Row("b", 1e-3, 1e-3, 0.0)};
  EXPECT_EQ(ParetoFront(rows, Accuracy::kNat), (std::vector<std::size_t>{1}));
}

TEST(Front, CheapestOfEveryDecade) {
  const auto choices = CheapestByDecade(Rows(), Accuracy::kNat);
  ASSERT_EQ(choices.size(), 4u);  // 3e-2 -> 1e-1; 1e-2 exactly; 8e-4 -> 1e-3; 2e-5 -> 1e-4
  const std::size_t expected[] = {1, 4, 3, 0};
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(choices[k].decade, k + 1);
    EXPECT_EQ(choices[k].row, expected[k]);
  }
}

TEST(Front, OneRowMayServeSeveralDecades) {
  const auto choices = CheapestByDecade({Row("a", 1e-3, 0.5, 0.0), Row("b", 2e-3, 1e-3, 0.0)}, Accuracy::kNat);
  ASSERT_EQ(choices.size(), 4u);
  EXPECT_EQ(choices[0].row, 0u);
  for (int k = 1; k < 4; ++k) EXPECT_EQ(choices[k].row, 1u);
}

TEST(Front, AnExactAnswerEndsTheDecades) {
  const auto choices = CheapestByDecade({Row("a", 1e-3, 0.0, 0.0)}, Accuracy::kNat);
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0].decade, 16);
}

TEST(Front, BestWithinTheBudget) {
  EXPECT_FALSE(BestWithin(Rows(), Accuracy::kNat, 0.9e-3).has_value());
  EXPECT_EQ(BestWithin(Rows(), Accuracy::kNat, 1e-3), 1u);
  EXPECT_EQ(BestWithin(Rows(), Accuracy::kNat, 3e-3), 3u);
  EXPECT_EQ(BestWithin(Rows(), Accuracy::kNat, 1.0), 0u);
}

TEST(Front, AsGoodMeansInBothMeasures) {
  std::vector<TradeoffRow> rows = Rows();
  EXPECT_EQ(CheapestAsGood(rows, rows[4]), 3u);  // "fast" is less deep, but has the larger nat
  rows[3].interpenetration_max = 7e-3;
  EXPECT_EQ(CheapestAsGood(rows, rows[4]), 0u);
  rows[4].nat = 1e-6;
  EXPECT_FALSE(CheapestAsGood(rows, rows[4]).has_value());
}

TEST(Statistics, PercentileIsTheNearestRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(Percentile(values, 0.99), 99.0);
  EXPECT_EQ(Percentile(values, 1.0), 100.0);
  EXPECT_EQ(Percentile({3.0}, 0.99), 3.0);
  EXPECT_EQ(Percentile({}, 0.99), 0.0);
  EXPECT_EQ(Median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(Median({4.0, 1.0, 2.0, 3.0}), 2.5);
}

TEST(Statistics, SecondsAreMediansByStepWithoutTheMeasuringPass) {
  Timings timings;
  TradeoffRow row;
  const auto add = [&](double a, double b) {
    timings.Begin();
    timings.Add(a);
    timings.Add(b);
  };
  add(9.0, 9.0);
  timings.Fill(&row);
  EXPECT_EQ(row.seconds, 9.0);  // all there is
  add(1.0, 3.0);
  add(2.0, 8.0);
  add(5.0, 4.0);
  timings.Begin();
  timings.Add(0.0);
  timings.DropLast();
  timings.Fill(&row);
  EXPECT_EQ(row.seconds, 3.0);  // (median 2 + median 4) / 2
  EXPECT_EQ(row.seconds_least, 2.0);
  EXPECT_EQ(row.seconds_most, 5.0);
  EXPECT_EQ(row.repetitions, 3);
}

StepMeasurement Solve(SolveStatus status, double nat) {
  StepMeasurement m;
  m.residuals.nat = nat;
  m.effort.status = status;
  m.effort.reason = NameOf(status);
  m.effort.sweeps = 6;
  m.growth.solver_mean = 1e-3;
  return m;
}

TEST(Rows, TellTheWorstStepAndMeasureInMeanRadii) {
  RowBuilder builder("runs", {"s", "nscd", {}}, 0.5);
  for (const auto status :
       {SolveStatus::kConverged, SolveStatus::kIterationLimit, SolveStatus::kConverged, SolveStatus::kConverged}) {
    builder.AddSolve(Solve(status, status == SolveStatus::kConverged ? 1e-4 : 1e-2));
  }
  builder.AddStep({1e-3, 2e-3, 4e-3}, 1.0, 1.5);
  builder.AddStep({3e-3, 2e-3, 2e-3}, 2.0, 1.9);
  const TradeoffRow row = builder.Build(false, "");
  EXPECT_EQ(row.status, "iteration_limit");
  EXPECT_EQ(row.reason, "iteration_limit");
  EXPECT_EQ(row.not_converged, 1);
  EXPECT_EQ(row.nat, 1e-4);
  EXPECT_EQ(row.nat_worst, 1e-2);
  EXPECT_EQ(row.steps, 2);
  EXPECT_EQ(row.sweeps, 12.0);  // two solves a step: substeps
  EXPECT_DOUBLE_EQ(row.growth.solver_mean, 4e-3);
  EXPECT_DOUBLE_EQ(row.interpenetration_mean, 4e-3);
  EXPECT_DOUBLE_EQ(row.interpenetration_max, 8e-3);
  EXPECT_DOUBLE_EQ(row.observable_error, 0.5);
  EXPECT_LT(row.velocity_error, 0.0);
  EXPECT_EQ(builder.Build(true, "").status, "cut");
  EXPECT_EQ(builder.Build(true, "no memory").status, "failed");
  EXPECT_EQ(builder.Build(false, "no memory").reason, "no memory");
}

TEST(Rows, WhatIsNoNumberIsNotTheMedian) {
  RowBuilder builder("runs", {"s", "nscd", {}}, 1.0);
  builder.AddSolve(Solve(SolveStatus::kDiverged, std::numeric_limits<double>::quiet_NaN()));
  builder.AddStep({}, 0.0, 0.0);
  const TradeoffRow row = builder.Build(false, "");
  EXPECT_TRUE(std::isinf(row.nat));
  EXPECT_TRUE(std::isnan(row.nat_worst));
  EXPECT_FALSE(row.is_sound());
}

TEST(Csv, EveryLineHasTheCellsOfTheHeader) {
  TradeoffRow row = Row("a, \"b\"", 1e-3, 1e-4, 1e-5);
  row.reason = "one, two\nthree";
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  const std::string line = TradeoffLine(row);
  EXPECT_EQ(commas(line), commas(TradeoffHeader()));
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  EXPECT_NE(line.find("tolerance=1e-3"), std::string::npos);
}

TEST(Text, SectionsSayAllThatTheSettingDoes) {
  Setting setting{"x", "nscdd", {{"subdomains", "2x2"}, {"tolerance", "1e-4"}, {"warm_start", "false"}}, 4};
  EXPECT_EQ(SolverSection(setting),
            "[solver]\nname = \"nscdd\"\nsubdomains = \"2x2\"\ntolerance = 1e-4\nwarm_start = false\n"
            "# and in [time]: divide dt by 4, multiply steps by 4\n");
}

TEST(Text, AdviceNamesTheCheapestOfEachDecadeAndTheBudget) {
  Plan plan;
  plan.stepping_texts = {{"theta", "0.5"}, {"alert_distance", "0.1"}};
  const std::string text = FormatAdvice(Rows(), {Accuracy::kNat, 3e-3}, plan);
  EXPECT_NE(text.find("# nat <= 1e-1: fast, 1 ms a step, nat 3.0e-02\n[solver]\nname = \"nscd\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# nat <= 1e-2: middle, "), std::string::npos) << text;
  EXPECT_NE(text.find("# nat <= 1e-3: middle, 2 ms a step, nat 8.0e-04 (the same)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# the most accurate within 3 ms a step: middle"), std::string::npos) << text;
  EXPECT_NE(text.find("alert_distance = 0.1\n"), std::string::npos);
  EXPECT_EQ(text.find("theta"), std::string::npos);
  EXPECT_EQ(text.find("Box2D"), std::string::npos);
  EXPECT_NE(FormatAdvice(Rows(), {Accuracy::kNat, 1e-6}, plan).find("# no setting takes at most"), std::string::npos);
}

TEST(Text, BesideBox2d) {
  std::vector<TradeoffRow> rows = Rows();
  EXPECT_NE(FormatBox2dComparison(rows).find("Box2D 8/3: middle is at least as good"), std::string::npos);
  EXPECT_NE(FormatBox2dComparison(rows).find("1.3 times slower"), std::string::npos);
  rows[3].seconds = 0.5e-3;
  EXPECT_NE(FormatBox2dComparison(rows).find("3.0 times faster"), std::string::npos);
  rows[4].nat = 0.0;
  EXPECT_NE(FormatBox2dComparison(rows).find("no setting is at least as good"), std::string::npos);
  rows.pop_back();
  EXPECT_EQ(FormatBox2dComparison(rows), "");
}

TEST(Text, TableMarksTheFrontAndHidesTheRest) {
  const std::string brief = FormatTable(Rows(), Accuracy::kNat, false), all = FormatTable(Rows(), Accuracy::kNat, true);
  EXPECT_NE(brief.find("* good"), std::string::npos);
  EXPECT_EQ(brief.find("beaten"), std::string::npos);
  EXPECT_NE(all.find("  beaten"), std::string::npos);
}

TEST(Plot, ScriptHoldsThePointsAndTheFront) {
  const std::string script = PlotScript("it's a scene", Rows(), "out.png");
  EXPECT_NE(script.find("'it''s a scene'"), std::string::npos);
  EXPECT_NE(script.find("title 'Box2D'"), std::string::npos);
  EXPECT_NE(script.find("title 'front'"), std::string::npos);
  EXPECT_NE(script.find("\n2 0.0008\n"), std::string::npos) << script;
}

}  // namespace
}  // namespace nscdd
