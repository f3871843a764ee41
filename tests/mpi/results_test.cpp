// SPDX-License-Identifier: Apache-2.0
// Several ranks write one set of results: the same final.csv as one rank, one results.h5, and the same error everywhere.
// Usage: mpirun -n N mpi_results FOLDER (which is emptied).
#include <fmt/format.h>
#include <mpi.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "nscdd/error.h"
#include "results/final_csv.h"
#include "results/results_file.h"
#include "results/results_reader.h"
#include "results/steps_csv.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

void Require(bool condition, const std::string& what) {
  if (condition) return;
  fmt::print(stderr, "failed: {}\n", what);
  MPI_Abort(MPI_COMM_WORLD, 1);
}

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

void Write(const fs::path& path, const RankGroup& ranks, int bodies) {
  ResultsFolder folder(path, {"a", "a.toml", "0", "0.1.0", {}}, ranks);
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

void CheckResults(const fs::path& base, int bodies) {
  Require(TextOf(base / "many" / "final.csv") == TextOf(base / "one" / "final.csv"), "final.csv is the same");
  Require(TextOf(base / "many" / "steps.csv") == TextOf(base / "one" / "steps.csv"), "steps.csv is the same");
  Require(!fs::exists(base / "one" / "communication.csv"), "one rank communicates with nobody");
  const ResultsReader many(base / "many"), one(base / "one");
  Require(many.ReadGrains(7).size() == static_cast<std::size_t>(bodies), "all bodies are in results.h5");
  Require(many.ReadGrains(7).id == one.ReadGrains(7).id && many.ReadGrains(7).x == one.ReadGrains(7).x, "their columns agree");
  Require(many.ReadContacts(7).size() == 0, "no contacts");
  Require(many.ReadShapes().size() == 1 && many.run().scene == "a", "shapes and attributes");
}

/// One rank fails, or rank 0 does: all throw, and the folder is as before.
void CheckErrors(const fs::path& base, const RankGroup& ranks) {
  const auto sentence_of = [](const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const int last = ranks.size() - 1;
  Require(sentence_of([&] {
            ranks.RunTogether([&] {
              if (ranks.rank() == last) throw Error("rank " + std::to_string(last));
            });
          }) == "rank " + std::to_string(last),
          "the last rank's error is everybody's");
  const auto other = [&] { ResultsFolder(base / "many", {"b", "b.toml", "0", "0.1.0", {}}, ranks); };
  Require(sentence_of(other).find("another folder") != std::string::npos, "another scene is refused on every rank");
  const auto unwritable = [&] { ResultsFolder("/proc/nscdd", {"b", "b.toml", "0", "0.1.0", {}}, ranks); };
  Require(sentence_of(unwritable).find("cannot write /proc/nscdd") != std::string::npos, "unwritable on every rank");
}

int Main(const fs::path& base) {
  const RankGroup ranks(MPI_COMM_WORLD);
  constexpr int kBodies = 1000;
  if (ranks.is_root()) fs::remove_all(base);
  Write(base / "many", ranks, kBodies);
  if (ranks.is_root()) {
    Write(base / "one", RankGroup(), kBodies);
    CheckResults(base, kBodies);
  }
  CheckErrors(base, ranks);
  MPI_Barrier(MPI_COMM_WORLD);
  if (ranks.is_root()) fs::remove_all(base);
  return 0;
}

}  // namespace
}  // namespace nscdd

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int status = argc == 2 ? nscdd::Main(argv[1]) : 1;
  MPI_Finalize();
  return status;
}
