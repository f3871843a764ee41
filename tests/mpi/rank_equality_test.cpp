// SPDX-License-Identifier: Apache-2.0
// Results depend on the number of subdomains, never on the number of ranks: the same bits on every number of ranks as without
// MPI.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "mpi_test.h"
#include "packing.h"

namespace nscdd::test {
namespace {

struct Case {
  const char* name;
  Packing packing;
  SteppingOptions stepping;
  NscddOptions nscdd;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
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

using RankEquality = MpiTestWithParam<Case>;

TEST_P(RankEquality, SameBitsAsWithoutMpi) {
  constexpr int kSteps = 20;
  const Case& c = GetParam();
  const Outcome outcome = test::Run(c.packing, c.stepping, c.nscdd, kSteps, &communicator);
  if (communicator.rank() != 0) return;
  SerialCommunicator serial;
  EXPECT_EQ(Difference(test::Run(c.packing, c.stepping, c.nscdd, kSteps, &serial), outcome), "");
  EXPECT_GT(outcome.reports.back().solve.active, 0) << "a test of contacts without any";
}

INSTANTIATE_TEST_SUITE_P(Packings, RankEquality, testing::ValuesIn(Cases()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nscdd::test
