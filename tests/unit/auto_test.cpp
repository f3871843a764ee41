// SPDX-License-Identifier: Apache-2.0
// Solver "auto": which rungs, and when the next one.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "auto/ladder.h"
#include "auto/pilot_state.h"
#include "auto/watcher.h"
#include "nscdd/error.h"
#include "nscdd/host/plugin_library.h"

namespace nscdd {
namespace {

using Verdict = Watcher::Verdict;

StepReport Step(double depth, SolveStatus status = SolveStatus::kConverged) {
  StepReport report;
  report.mean_radius = 0.5;
  report.max_interpenetration = depth;
  report.solve.status = status;
  return report;
}

AutoSettings Depth(double wish) { return {wish, true, {}}; }

TEST(AutoWatcher, StaysWhileAllIsWell) {
  Watcher watcher(Depth(1e-2));  // 5e-3 m
  EXPECT_FALSE(watcher.IsTooDeep(Step(4.9e-3)));
  EXPECT_EQ(watcher.Judge(Step(4.9e-3), 0.0, 1.0, true, true), Verdict::kStay);
  EXPECT_EQ(watcher.state().escalations, 0);
  EXPECT_NE(watcher.Summary("x", "y").find("no step of 1 went deeper than wished"), std::string::npos);
}

TEST(AutoWatcher, ClimbsWhenTheSolverLetsContactsDeepen) {
  Watcher watcher(Depth(1e-2));
  EXPECT_EQ(watcher.Judge(Step(6e-3), 2e-3, 1.0, true, true), Verdict::kClimb);
  EXPECT_EQ(watcher.Judge(Step(8e-3), 2e-3, 1.0, false, true), Verdict::kStay);  // at the top: said, not done
  EXPECT_EQ(watcher.state().escalations, 1);
  EXPECT_NE(watcher.Summary("x", "y").find("2 of 2 steps went deeper"), std::string::npos);
}

TEST(AutoWatcher, DoesNotBlameTheSolverForGeometryOrForTheStart) {
  Watcher watcher(Depth(1e-2));
  EXPECT_EQ(watcher.Judge(Step(6e-3), 1e-6, 1.0, true, true), Verdict::kStay);
  EXPECT_NE(watcher.Summary("x", "y").find("in 1 of them for the time step's sake"), std::string::npos);
  EXPECT_FALSE(watcher.IsTooDeep(Step(6e-3)));  // it was so before
  Watcher deep(Depth(1e-2));
  deep.SetStart(0.2);
  EXPECT_FALSE(deep.IsTooDeep(Step(0.2)));
  EXPECT_TRUE(deep.IsTooDeep(Step(0.21)));
}

TEST(AutoWatcher, ClimbsWhenAStepFails) {
  for (const SolveStatus status : {SolveStatus::kIterationLimit, SolveStatus::kStalled, SolveStatus::kDiverged}) {
    Watcher watcher(Depth(1e-2));
    EXPECT_EQ(watcher.Judge(Step(0.0, status), 0.0, 1.0, true, false), Verdict::kClimb);
  }
  Watcher watcher(Depth(1e-2));
  EXPECT_EQ(watcher.Judge(Step(0.0, SolveStatus::kFixed), 0.0, 1.0, true, false), Verdict::kStay);  // as asked
  EXPECT_EQ(watcher.Judge(Step(0.0, SolveStatus::kIncomplete), 0.0, 1.0, true, false), Verdict::kStay);
  EXPECT_TRUE(watcher.IsTooDeep(Step(std::numeric_limits<double>::quiet_NaN())));
}

TEST(AutoWatcher, KeepsTheBudget) {
  Watcher watcher({{}, true, 1e-3});
  for (int k = 0; k < 9; ++k) EXPECT_EQ(watcher.Judge(Step(1.0), 0.0, 4e-4, true, true), Verdict::kStay);
  EXPECT_EQ(watcher.Judge(Step(1.0), 0.0, 4e-4, true, true), Verdict::kClimb);
  EXPECT_EQ(watcher.Judge(Step(1.0), 0.0, 2e-3, true, true), Verdict::kDescend);
  for (int k = 0; k < 30; ++k) EXPECT_EQ(watcher.Judge(Step(1.0), 0.0, 4e-4, true, true), Verdict::kStay);  // once bitten
  EXPECT_EQ(watcher.state().escalations, 1);
  EXPECT_EQ(watcher.state().descents, 1);
  EXPECT_NE(watcher.Summary("x", "y").find("1 of 41 steps took longer"), std::string::npos);
}

class AutoFront : public testing::Test {
 protected:
  void SetUp() override { registry_.Add(FindPlugin("")); }
  std::filesystem::path Write(const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / "auto_test.front.csv";
    std::ofstream(file) << text;
    return file;
  }
  static FrontEntry Entry(const std::string& name, double seconds, double depth, const std::string& grid) {
    return {{name, "nscdd", {{"subdomains", grid}}}, seconds, 1e-3, depth};
  }
  SolverRegistry registry_;
};

TEST_F(AutoFront, ReadsWhatTradeoffWrites) {
  const auto file = Write(
      "view,setting,solver,options,nat,interpenetration_max,seconds\n"
      "runs,quick one,nscdd,subdomains=2x2;tolerance=1e-2,1e-2,5e-3,0.001\n");
  const std::vector<FrontEntry> front = ReadFront(file);
  ASSERT_EQ(front.size(), 1u);
  EXPECT_EQ(front[0].setting.name, "quick one");
  EXPECT_EQ(front[0].setting.Option("subdomains"), "2x2");
  EXPECT_EQ(front[0].setting.Option("tolerance"), "1e-2");
  EXPECT_EQ(front[0].seconds, 0.001);
  EXPECT_EQ(front[0].interpenetration, 5e-3);
  EXPECT_EQ(FrontFileOf("a/b.toml"), "a/b.front.csv");
}

TEST_F(AutoFront, RefusesWhatItCannotRead) {
  EXPECT_THROW(ReadFront("/nowhere/x.front.csv"), Error);
  EXPECT_THROW(ReadFront(Write("")), Error);
  EXPECT_THROW(ReadFront(Write("setting,solver,options,nat,seconds\na,nscd,,1,1\n")), Error);
  try {
    ReadFront(Write("setting,solver,options,nat,interpenetration_max,seconds\na,nscd,,1,x,1\n"));
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(":2: column 'interpenetration_max' is 'x'"), std::string::npos) << e.what();
  }
  for (const char* grid : {"abc", "2x", "x2", "0x3", "2x2x2", "99999999999x9", "-1x-1"}) {
    const std::string line = std::string("a,nscdd,subdomains=") + grid + ",1,1,1\n";
    EXPECT_THROW(ReadFront(Write("setting,solver,options,nat,interpenetration_max,seconds\n" + line)), Error) << grid;
  }
}

TEST_F(AutoFront, SafeLadderBeginsCheapAndIsKnownToThePlugin) {
  const std::vector<Setting> one = SafeLadder("1x1", registry_), many = SafeLadder("2x3", registry_);
  ASSERT_GE(one.size(), 4u);
  EXPECT_EQ(one.front().solver, "nscd");
  ASSERT_EQ(many.size(), 5u);
  EXPECT_EQ(many[0].solver, "iea");
  EXPECT_EQ(many[1].Option("closing_updates"), "20");
  EXPECT_EQ(many[4].solver, "nscdd");
  for (const Setting& rung : many) EXPECT_EQ(rung.Option("subdomains"), "2x3");
  for (const auto* ladder : {&one, &many}) {
    for (const Setting& rung : *ladder)
      EXPECT_NO_THROW(registry_.Create({rung.solver, rung.options, nullptr, {}})) << rung.name;
  }
}

TEST_F(AutoFront, BeginsWithTheCheapestThatServes) {
  const std::vector<FrontEntry> front = {Entry("a", 1e-3, 1e-2, "2x2"), Entry("b", 2e-3, 1e-3, "4x4"),
                                         Entry("c", 3e-3, 5e-4, "2x2"), Entry("d", 4e-3, 1e-4, "4x4")};
  const auto names = [&](const AutoSettings& wish, const std::string& grid, int ranks) {
    std::string text;
    for (const Setting& rung : MakeLadder(wish, grid, ranks, front, "f", registry_).rungs) text += rung.name.substr(0, 1);
    return text;
  };
  EXPECT_EQ(names(Depth(2e-2), "", 1).substr(0, 2), "ac");  // stays on one grid
  EXPECT_EQ(names(Depth(1e-3), "", 1).substr(0, 2), "bd");
  EXPECT_EQ(names(Depth(1e-9), "", 1).substr(0, 1), "d");  // nothing so good
  EXPECT_EQ(names(Depth(1e-3), "2x2", 1).substr(0, 1), "c");
  EXPECT_EQ(names(Depth(2e-2), "", 6).substr(0, 2), "bd");  // 2x2 is too few for six ranks
  EXPECT_EQ(names({{}, true, 2.5e-3}, "", 1).substr(0, 2), "bd");
  EXPECT_EQ(names(Depth(1e-3), "", 1).substr(2), "nnn");  // then the built-in ones that converge
  EXPECT_EQ(MakeLadder(Depth(1e-3), "3x3", 1, front, "f", registry_).origin, "safe defaults");
  EXPECT_EQ(MakeLadder(Depth(1e-3), "", 1, front, "f", registry_).origin, "f");
}

TEST(AutoState, ReadsBackAndRefusesCountsThatAreNone) {
  PilotState state;
  state.ladder.rungs.resize(2);
  state.choices.resize(2);
  state.rung = 1;
  state.watcher.depth = 2.5e-3;
  state.watcher.steps = 7;
  const std::string text = FormatPilotState(state);
  const PilotState read = ParsePilotState(text);
  EXPECT_EQ(read.rung, 1u);
  EXPECT_EQ(read.watcher.depth, 2.5e-3);
  EXPECT_EQ(read.watcher.steps, 7);
  for (const char* bad : {"1e300", "-1.5", "2", "\"1\"", "null"}) {
    std::string other = text;
    other.replace(other.find("\"rung\":1"), 8, std::string("\"rung\":") + bad);
    EXPECT_THROW(ParsePilotState(other), Error) << bad;
  }
}

}  // namespace
}  // namespace nscdd
