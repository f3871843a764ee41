// SPDX-License-Identifier: Apache-2.0
// Results depend on the number of subdomains, never on the number of ranks: the same bits on 1, 2, 3 and 4 ranks, and without
// MPI. Started on four ranks; smaller numbers of ranks are parts of them.

#include <fmt/format.h>
#include <mpi.h>

#include <optional>
#include <string>

#include "packing.h"
#include "rank_part.h"

namespace nscdd::test {
namespace {

struct Case {
  const char* name;
  Packing packing;
  SteppingOptions stepping;
  NscddOptions nscdd;
};

std::vector<Case> Cases() {
  NscddOptions two, four, many, crowded, lazy, strips;
  for (NscddOptions* o : {&two, &four, &many, &crowded, &lazy, &strips}) o->stopping.max_iterations = 300;
  two.partition = {2, 2, 1};
  four.partition = {1, 4, 1};
  many.partition = {4, 3, 1};
  many.sweeps_per_stage = 3;
  crowded.partition = {23, 17, 1};
  lazy.partition = {3, 2, 4};
  strips.partition = {1, 23, 1};  // cuts of ranks between grains and their only contacts
  SteppingOptions cold, feedback, qm16;
  cold.warm_start = false;
  feedback.normal_law = NormalLaw::kFeedback;
  NscddOptions by_qm16 = two;
  by_qm16.stopping.criterion = Criterion::kQm16;
  return {{"friction", {}, {}, two},
          {"frictionless", {.friction = 0.0}, {}, four},
          {"half_rough", {.half_rough = true}, {}, four},  // the uppermost rank sees no friction
          {"clusters", {.clusters = true}, {}, many},
          {"frictionless_clusters", {.friction = 0.0, .clusters = true}, {}, two},
          {"periodic", {.periodic = true}, {}, many},
          {"turning_wall", {.restitution = 0.4, .turning_wall = true}, {}, two},
          {"all_on_the_interface", {.columns = 6, .rows = 5}, feedback, crowded},
          {"lazy_partition", {}, cold, lazy},
          {"one_contact_each", {.pegs = true}, {}, strips},
          {"qm16", {}, {}, by_qm16}};
}

/// Number of failures, the same on all ranks.
int Check(const Case& c, int rank) {
  constexpr int kSteps = 20;
  int failures = 0;
  SerialCommunicator serial;
  std::optional<Outcome> expected;
  if (rank == 0) expected = Run(c.packing, c.stepping, c.nscdd, kSteps, &serial);
  for (int ranks = 1; ranks <= 4; ++ranks) {
    OnFirstRanks(ranks, [&](Communicator* communicator) {
      const Outcome outcome = Run(c.packing, c.stepping, c.nscdd, kSteps, communicator);
      if (rank != 0) return;
      const std::string difference = Difference(*expected, outcome);
      const std::int64_t active = outcome.reports.back().solve.active;
      std::int64_t migrated = 0;
      for (const StepReport& r : outcome.reports) migrated += r.migrated_bodies;
      fmt::print("{} {} on {} ranks: {} active contacts at the end, {} bodies moved between ranks {}\n",
                 difference.empty() ? "ok    " : "FAILED", c.name, ranks, active, migrated, difference);
      failures += !difference.empty() || active == 0;
    });
  }
  MPI_Bcast(&failures, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return failures;
}

}  // namespace
}  // namespace nscdd::test

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int failures = 0;
  for (const auto& c : nscdd::test::Cases()) failures += nscdd::test::Check(c, rank);
  MPI_Finalize();
  return failures == 0 ? 0 : 1;
}
