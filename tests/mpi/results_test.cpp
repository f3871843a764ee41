// SPDX-License-Identifier: Apache-2.0
// Several ranks write one set of results: the same final.csv as one rank, one results.h5, and the same error everywhere.

#include <mpi.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "mpi_test.h"
#include "nscdd/error.h"
#include "results/final_csv.h"
#include "results/results_file.h"
#include "results/results_reader.h"
#include "results/steps_csv.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Bodies of rank `rank` of `size`: every size-th one, none on the last of several ranks; backwards.
GrainTable GrainsOf(int rank, int size, int bodies) {
  const int owners = size > 2 ? size - 1 : size;
  GrainTable grains;
  for (int i = bodies - 1; i >= 0; --i) {
    if ((i / 7) % owners != rank) continue;
    grains.id.push_back(std::int64_t{3} * i);
    grains.x.push_back(1.0 / (i + 1));
    grains.y.push_back(-i);
  }
  for (auto* column : {&grains.angle, &grains.vx, &grains.vy, &grains.spin, &grains.radius})
    column->resize(grains.id.size(), 0.1);
  for (auto* column : {&grains.multiplicity, &grains.subdomain}) column->resize(grains.id.size(), rank);
  grains.kind.resize(grains.id.size());
  return grains;
}

ShapeTable ShapesOf(int rank) {
  ShapeTable shapes;
  if (rank != 0) return shapes;
  shapes.body = {3};
  shapes.kind = {ShapeKind::kSegment};
  shapes.x0 = shapes.y0 = shapes.x1 = shapes.y1 = shapes.radius = {0.5};
  return shapes;
}

RunIdentity RunOf(const std::string& scene) {
  RunIdentity run;
  run.scene = scene;
  run.scene_file = scene + ".toml";
  run.scene_hash = "0";
  run.version = "0.1.0";
  return run;
}

void Write(const fs::path& path, const RankGroup& ranks, int bodies) {
  ResultsFolder folder(path, RunOf("a"), ranks);
  StepsCsv steps(&folder);
  steps.Append({});
  steps.Close();
  const GrainTable grains = GrainsOf(ranks.rank(), ranks.size(), bodies);
  WriteFinalCsv(
      &folder, grains, [](std::int64_t) { return std::string_view(); }, 100);
  ResultsFile file(&folder, {"a", "nscdd", "0.1.0", 2, 2, 0.0, 0.0, 0.1}, ShapesOf(ranks.rank()));
  file.Save({7, 0.7, 0.1}, grains, {});
  file.Close();
  folder.Finish();
}

/// Has a folder to itself, which is emptied.
class Results : public testing::Test {
 protected:
  void SetUp() override {
    if (ranks.is_root()) fs::remove_all(base);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  void TearDown() override {
    MPI_Barrier(MPI_COMM_WORLD);
    if (ranks.is_root()) fs::remove_all(base);
  }

  static constexpr int kBodies = 1000;
  const RankGroup ranks{MPI_COMM_WORLD};
  const fs::path base = RESULTS_FOLDER "_" + std::to_string(ranks.size());
};

TEST_F(Results, OfAllRanksAreThoseOfOne) {
  Write(base / "many", ranks, kBodies);
  if (!ranks.is_root()) return;
  Write(base / "one", RankGroup(), kBodies);
  EXPECT_EQ(TextOf(base / "many" / "final.csv"), TextOf(base / "one" / "final.csv"));
  EXPECT_EQ(TextOf(base / "many" / "steps.csv"), TextOf(base / "one" / "steps.csv"));
  EXPECT_FALSE(fs::exists(base / "one" / "communication.csv")) << "one rank communicates with nobody";
  const ResultsReader many(base / "many"), one(base / "one");
  EXPECT_EQ(many.ReadGrains(7).size(), static_cast<std::size_t>(kBodies));
  EXPECT_EQ(many.ReadGrains(7).id, one.ReadGrains(7).id);
  EXPECT_EQ(many.ReadGrains(7).x, one.ReadGrains(7).x);
  EXPECT_EQ(many.ReadContacts(7).size(), 0U);
  EXPECT_EQ(many.ReadShapes().size(), 1U);
  EXPECT_EQ(many.run().scene, "a");
}

std::string RefusalOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST_F(Results, TheLastRanksErrorIsEverybodys) {
  const std::string sentence = "rank " + std::to_string(ranks.size() - 1);
  EXPECT_EQ(RefusalOf([&] {
              ranks.RunTogether([&] {
                if (ranks.rank() == ranks.size() - 1) throw Error(sentence);
              });
            }),
            sentence);
}

TEST_F(Results, WhatRankZeroRefusesAllRefuse) {
  Write(base / "many", ranks, kBodies);
  const auto other = [&] { ResultsFolder(base / "many", RunOf("b"), ranks); };
  EXPECT_TRUE(test::Says(RefusalOf(other), "another folder"));
  const auto unwritable = [&] { ResultsFolder("/proc/nscdd", RunOf("b"), ranks); };
  EXPECT_TRUE(test::Says(RefusalOf(unwritable), "cannot write /proc/nscdd"));
}

}  // namespace
}  // namespace nscdd
