// SPDX-License-Identifier: Apache-2.0
// What the terminal shows during and after a run.
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "results/progress_bar.h"
#include "results/run_summary.h"

namespace nscdd {
namespace {

/// Output of `steps` steps of one second each.
std::string Output(ProgressBar::Style style, std::int64_t steps, double seconds_per_step) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  {
    double now = 100.0;
    ProgressBar bar(stream, style, steps, [&] { return now; });
    for (std::int64_t i = 1; i <= steps; ++i) {
      now += seconds_per_step;
      StepReport row;
      row.step = i;
      row.solve.iterations = 42;
      if (i == 3) row.solve.status = SolveStatus::kStalled;
      bar.Update(row);
    }
  }
  std::fclose(stream);
  const std::string output(text, size);
  std::free(text);
  return output;
}

TEST(ProgressBar, PlainLinesEveryTenth) {
  const std::string output = Output(ProgressBar::Style::kLines, 1000, 0.001);
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 10);
  EXPECT_NE(output.find(" 50 %  step 500/1000"), std::string::npos) << output;
  EXPECT_NE(output.find("1 not converged"), std::string::npos);
  EXPECT_EQ(output.find('\r'), std::string::npos);
}

TEST(ProgressBar, SlowRunsSpeakMoreOften) {
  const std::string output = Output(ProgressBar::Style::kLines, 40, 30.0);
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 40);
  EXPECT_NE(output.find("step 20/40"), std::string::npos);
  EXPECT_NE(output.find("10:00 left"), std::string::npos) << output;  // 20 steps of 30 s
}

TEST(ProgressBar, BarRedrawsOneLine) {
  const std::string output = Output(ProgressBar::Style::kBar, 50, 1.0);
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1);
  EXPECT_EQ(std::count(output.begin(), output.end(), '\r'), 50);
  EXPECT_NE(output.find("100 %  step 50/50"), std::string::npos);
  EXPECT_NE(output.find("00:50 taken\x1b[K\n"), std::string::npos) << output;
  // Not faster than the eye.
  const std::string fast = Output(ProgressBar::Style::kBar, 1000, 0.001);
  EXPECT_LE(std::count(fast.begin(), fast.end(), '\r'), 13);
}

TEST(ProgressBar, QuietSaysNothing) {
  EXPECT_EQ(Output(ProgressBar::Style::kNone, 10, 1.0), "");
  EXPECT_EQ(ProgressBar::StyleFor(stderr, true), ProgressBar::Style::kNone);
}

/// The style of a terminal of so many columns.
ProgressBar::Style StyleOfTerminal(unsigned short columns) {
  const winsize size{.ws_row = 0, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  int outside = -1, inside = -1;
  EXPECT_EQ(::openpty(&outside, &inside, nullptr, nullptr, &size), 0);
  std::FILE* stream = ::fdopen(inside, "w");
  const ProgressBar::Style style = ProgressBar::StyleFor(stream, false);
  std::fclose(stream);
  ::close(outside);
  return style;
}

// mpirun > FILE gives its ranks a terminal without columns.
TEST(ProgressBar, OnlyATerminalWithColumnsIsRedrawn) {
  EXPECT_EQ(StyleOfTerminal(80), ProgressBar::Style::kBar);
  EXPECT_EQ(StyleOfTerminal(0), ProgressBar::Style::kLines);
  std::FILE* file = std::tmpfile();
  EXPECT_EQ(ProgressBar::StyleFor(file, false), ProgressBar::Style::kLines);
  std::fclose(file);
}

RunSummary SampleSummary() {
  RunSummary summary;
  summary.scene = "rotating_box_730";
  summary.adapter = "box2d";
  summary.solver = "nscdd";
  summary.criterion = "nat <= 0.0001";
  summary.output = "results/rotating_box_730";
  summary.ranks = 2;
  summary.subdomains_x = 4;
  summary.subdomains_y = 2;
  summary.steps_asked = 4;
  summary.seconds_wall = 5.0;
  for (int i = 1; i <= 4; ++i) {
    StepReport row;
    row.step = i;
    row.time = 0.01 * i;
    row.bodies = 730;
    row.solve.iterations = 10 * i;
    row.solve.residuals.nat = 1e-5 * i;
    row.mean_interpenetration = 1e-6 * i;
    row.max_interpenetration = 1e-5 * (5 - i);
    row.mean_radius = 0.01;
    row.alert_distance = 1.0;
    row.seconds_total = 1.0;
    row.seconds_solve = 0.5;
    row.messages = 100;
    row.solve.unknowns_per_contact = i == 1 ? 1 : 2;  // a pair without friction meets first
    row.solve.unknowns_per_body = 3;
    row.solve.bytes_per_contact = i == 1 ? 64 : 112;
    row.solve.bytes_per_body = 40;
    row.solve.residuals.worst_body_a = 4;
    row.solve.residuals.worst_body_b = 9;
    row.solve.reason = "1000 iterations without success";
    if (i >= 3) row.solve.status = i == 3 ? SolveStatus::kIterationLimit : SolveStatus::kStalled;
    summary.Add(row);
  }
  return summary;
}

TEST(RunSummary, GathersMeansAndMaxima) {
  const std::string table = FormatSummary(SampleSummary());
  for (const char* part :
       {"rotating_box_730, on box2d", "nscdd, 4x2 subdomains, 2 ranks", "nat <= 0.0001",
        "4 of 4, 0.04 s simulated: 2 converged, 1 iteration_limit, 1 stalled", "mean 25.0, max 40",
        "mean 2.50e-05, max 4.00e-05", "mean 2.500e-06 m, max 4.000e-05 m = 2.50e-04 and 4.00e-03 mean radii", "solve 2.000",
        "other 2.000, outside steps 1.000",
        "unknowns: 1 to 2 per contact, 3 per body; bytes swept: 64 to 112 per contact, 40 per body", "400 messages",
        "results/rotating_box_730"}) {
    EXPECT_NE(table.find(part), std::string::npos) << part << " is not in\n" << table;
  }
}

TEST(RunSummary, AFixedNumberOfIterationsIsNoFailure) {
  RunSummary summary;
  StepReport row;
  row.solve.status = SolveStatus::kFixed;
  row.solve.residuals.nat = 0.25;
  for (int i = 0; i < 2; ++i) summary.Add(row);
  EXPECT_EQ(summary.not_converged(), 0);
  const std::string table = FormatSummary(summary);
  EXPECT_EQ(table.find("NOT CONVERGED"), std::string::npos) << table;
  EXPECT_NE(table.find("2 fixed"), std::string::npos) << table;
  EXPECT_NE(
      table.find("FIXED: in 2 steps as many iterations were made as asked for, whatever the residual (nat up to 2.50e-01)"),
      std::string::npos)
      << table;
}

TEST(RunSummary, NonConvergenceIsOneLoudLine) {
  const RunSummary summary = SampleSummary();
  EXPECT_EQ(summary.not_converged(), 2);
  const std::string table = FormatSummary(summary);
  const std::string line =
      "NOT CONVERGED: 2 of 4 steps (1 iteration_limit, 1 stalled); first: step 3, nat 3.00e-05, worst contact of bodies 4 and "
      "9: "
      "1000 iterations without success\n";
  EXPECT_NE(table.find(line), std::string::npos) << table;
  EXPECT_EQ(table.find("NOT CONVERGED"), table.rfind("NOT CONVERGED"));
  EXPECT_EQ(FormatSummary(RunSummary()).find("NOT CONVERGED"), std::string::npos);
}

TEST(RunSummary, FastBodiesAreMentioned) {
  RunSummary summary;
  StepReport row;
  summary.Add(row);
  EXPECT_EQ(FormatSummary(summary).find("FAST BODIES"), std::string::npos);
  row.beyond_reach = 2;
  summary.Add(row);
  EXPECT_NE(FormatSummary(summary).find("FAST BODIES: in 1 step "), std::string::npos);
}

TEST(RunSummary, UnevenConvergenceIsMentioned) {
  RunSummary summary;
  StepReport row;
  row.solve.status = SolveStatus::kConverged;
  row.solve.residuals.nat_max = 0.4;
  summary.Add(row);
  EXPECT_EQ(FormatSummary(summary).find("UNEVEN"), std::string::npos);
  row.solve.residuals.nat_max = 0.9;
  summary.Add(row);
  EXPECT_NE(FormatSummary(summary).find("UNEVEN: in 1 step "), std::string::npos);
}

// Ids are no quantities: their sum would overflow.
TEST(RunSummary, DoesNotAddIds) {
  RunSummary summary;
  StepReport row;
  row.solve.residuals.worst_body_a = std::numeric_limits<std::int64_t>::max();
  row.solve.iterations = std::numeric_limits<std::int32_t>::max();
  for (int i = 0; i < 3; ++i) summary.Add(row);
  EXPECT_EQ(summary.sum.solve.residuals.worst_body_a, 0);
  EXPECT_EQ(summary.sum.solve.iterations, std::int64_t{3} * std::numeric_limits<std::int32_t>::max());
}

}  // namespace
}  // namespace nscdd
