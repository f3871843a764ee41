// SPDX-License-Identifier: Apache-2.0
// steps.csv and final.csv.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "results/final_csv.h"
#include "results/steps_csv.h"
#include "results_sample.h"

namespace nscdd {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

TEST(StepsCsv, HeaderBeginsAsPromisedAndRowsFitIt) {
  const TemporaryFolder folder;
  ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
  StepsCsv steps(&results);
  StepReport row;
  row.step = 12;
  row.time = 0.1;
  row.solve.contacts = 34;
  row.solve.status = SolveStatus::kIterationLimit;
  row.solve.residuals.nat = std::nextafter(1e-4, 1.0);
  row.solve.residuals.interface_jump = std::numeric_limits<double>::quiet_NaN();
  row.solve.reason = "10000 iterations, \"limit\"\nreached";
  steps.Append(row);
  const std::vector<std::string> while_running = Split(TextOf(folder.path() / "steps.csv.part"), '\n');
  ASSERT_EQ(while_running.size(), 2u);
  steps.Append(row);
  steps.Close();
  results.Finish();

  const std::vector<std::string> lines = Split(TextOf(folder.path() / "steps.csv"), '\n');
  ASSERT_EQ(lines.size(), 3u);
  const std::string promised =
      "step,time,contacts,active,iterations,status,nat,nat_max,qm16,interface_jump,mean_interpenetration,max_interpenetration,"
      "kinetic_energy,momentum_x,momentum_y,seconds_detect,seconds_solve,seconds_communicate,";
  EXPECT_EQ(lines[0].substr(0, promised.size()), promised);
  const std::vector<std::string> cells = Split(lines[1], ',');
  ASSERT_EQ(cells.size(), Split(lines[0], ',').size());
  EXPECT_EQ(cells[0], "12");
  EXPECT_EQ(cells[1], "0.1");
  EXPECT_EQ(cells[2], "34");
  EXPECT_EQ(cells[5], "iteration_limit");
  EXPECT_EQ(std::stod(cells[6]), row.solve.residuals.nat);  // every bit survives
  EXPECT_EQ(cells[9], "nan");
  const std::vector<std::string> names = Split(lines[0], ',');
  const auto reason = std::find(names.begin(), names.end(), "reason") - names.begin();
  EXPECT_EQ(cells[static_cast<std::size_t>(reason)], "10000 iterations;  limit  reached");
}

TEST(StepsCsv, WhatDependsOnTheRanksIsElsewhere) {
  const TemporaryFolder folder;
  ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
  StepsCsv steps(&results);
  StepReport row;
  steps.Append(row);
  row.messages = row.message_bytes = row.collectives = row.migrated_bodies = 77;
  steps.Append(row);
  const std::vector<std::string> lines = Split(TextOf(folder.path() / "steps.csv.part"), '\n');
  EXPECT_EQ(lines[1], lines[2]);
}

StepReport RowOfStep(std::int64_t step) {
  StepReport row;
  row.step = step;
  row.time = 0.1 * static_cast<double>(step);
  row.solve.residuals.nat = 1.0 / static_cast<double>(3 * step);
  row.solve.residuals.worst_body_a = -1;
  row.solve.status = SolveStatus::kStalled;
  row.solve.reason = "";
  return row;
}

TEST(StepsCsv, GoesOnWhereItWasKept) {
  const TemporaryFolder folder;
  std::vector<FileExtent> kept;
  std::string text;
  {
    ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
    StepsCsv steps(&results);
    for (const std::int64_t step : {1, 2}) steps.Append(RowOfStep(step));
    kept = steps.Keep();
    text = TextOf(folder.path() / "steps.csv.part");
    steps.Append(RowOfStep(3));
    results.KeepParts();
  }
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].size, text.size());
  EXPECT_NO_THROW(CheckExtent(folder.path(), kept[0]));
  std::vector<StepReport> rows;
  ForEachStep(folder.path(), kept, [&](const StepReport& row) { rows.push_back(row); });
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].step, 2);
  EXPECT_EQ(rows[1].solve.residuals.nat, 1.0 / 6.0);  // every bit survives
  EXPECT_EQ(rows[1].solve.residuals.worst_body_a, -1);
  EXPECT_EQ(rows[1].solve.status, SolveStatus::kStalled);
  ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());  // takes the parts away
  std::ofstream(folder.path() / "steps.csv.part") << text << "3,half a row";
  StepsCsv steps(&results, kept);
  EXPECT_EQ(TextOf(folder.path() / "steps.csv.part"), text);
  steps.Append(RowOfStep(3));
  const std::vector<FileExtent> later = steps.Keep();
  EXPECT_NO_THROW(CheckExtent(folder.path(), later[0]));  // its checksum is that of all rows
  EXPECT_EQ(Split(TextOf(folder.path() / "steps.csv.part"), '\n').size(), 4u);
}

TEST(StepsCsv, RowsOfAnotherProgramAreNamed) {
  const TemporaryFolder folder;
  ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
  StepsCsv steps(&results);
  steps.Append(RowOfStep(1));
  steps.Keep();
  const std::string good = TextOf(folder.path() / "steps.csv.part");
  const auto refusal = [&](const std::string& text) {
    std::ofstream(folder.path() / "steps.csv.part") << text;
    const std::vector<FileExtent> extent = {ExtentOf(folder.path(), "steps.csv.part")};
    return SentenceOf([&] { ForEachStep(folder.path(), extent, [](const StepReport&) {}); });
  };
  EXPECT_EQ(refusal(good), "");
  EXPECT_NE(refusal("a" + good).find("steps.csv.part:1: "), std::string::npos);
  EXPECT_NE(refusal(good + "2,3\n").find("steps.csv.part:3: "), std::string::npos);
  EXPECT_NE(refusal(good + "x" + good.substr(good.find('\n') + 2)).find("steps.csv.part:3: "), std::string::npos);
  const std::size_t word = good.find("stalled");
  EXPECT_NE(refusal(good.substr(0, word) + "exploded" + good.substr(word + 7)).find("steps.csv.part:2: "), std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.size() - 1)), "");
  EXPECT_NE(refusal(""), "");
}

std::string_view AllDisks(std::int64_t) { return {}; }

TEST(FinalCsv, SortedWithSeventeenDigits) {
  const TemporaryFolder folder;
  ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
  GrainTable grains = SampleGrains();
  grains.radius[1] = 0.1;
  WriteFinalCsv(&results, grains, [](std::int64_t id) { return id == 9 ? "cluster" : ""; });
  results.Finish();
  EXPECT_EQ(TextOf(folder.path() / "final.csv"),
            "id,x,y,angle,vx,vy,spin,radius,kind\n"
            "7,1,1,0.20000000000000001,0.33333333333333331,0.5,0,0.10000000000000001,free\n"
            "9,3,1,-0.29999999999999999,-2,0,-0,1,cluster\n"
            "30,5,1,0.10000000000000001,0,0,1e-300,1,free\n"
            "40,3,0,0,0,0,0,0.5,prescribed\n");
}

TEST(FinalCsv, ChunksGiveTheSameFile) {
  const TemporaryFolder folder;
  GrainTable grains;
  for (std::int64_t i = 0; i < 1000; ++i) grains.id.push_back((i * 7919) % 1000 * 9'000'000'000'000'000);
  for (auto* column : {&grains.x, &grains.y, &grains.angle, &grains.vx, &grains.vy, &grains.spin, &grains.radius}) {
    column->resize(1000);
    std::iota(column->begin(), column->end(), 0.5);
  }
  grains.kind.resize(1000);
  const auto text_with = [&](int rows_at_a_time) {
    ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
    WriteFinalCsv(&results, grains, AllDisks, rows_at_a_time);
    results.Finish();
    return TextOf(folder.path() / "final.csv");
  };
  const std::string whole = text_with(100000);
  EXPECT_EQ(Split(whole, '\n').size(), 1001u);
  EXPECT_EQ(text_with(1), whole);
  EXPECT_EQ(text_with(333), whole);
  EXPECT_EQ(text_with(1000), whole);
}

TEST(FinalCsv, IdsThatComeTwiceAreRefused) {
  const TemporaryFolder folder;
  ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
  GrainTable grains = SampleGrains();
  grains.id[3] = 9;
  EXPECT_NE(SentenceOf([&] { WriteFinalCsv(&results, grains, AllDisks); }).find("two bodies have the id 9"), std::string::npos);
}

TEST(FinalCsv, NoBodies) {
  const TemporaryFolder folder;
  ResultsFolder results(folder.path(), IdentityOf("a"), RankGroup());
  WriteFinalCsv(&results, {}, AllDisks);
  results.Finish();
  EXPECT_EQ(TextOf(folder.path() / "final.csv"), "id,x,y,angle,vx,vy,spin,radius,kind\n");
}

}  // namespace
}  // namespace nscdd
