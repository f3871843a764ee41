// SPDX-License-Identifier: Apache-2.0
// Handles of the plugin over a communicator, on two ranks.

#include <mpi.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mpi_test.h"
#include "nscdd/error.h"
#include "nscdd/host/adapter_host.h"
#include "nscdd/host/solver.h"
#include "nscdd/reference/reference_adapter.h"
#include "validator/two_disk_host.h"

namespace nscdd {
namespace {

/// Handles over all ranks; an error on one of them is the same sentence on both, and nobody waits.
class Handles : public test::MpiTest {
 protected:
  static void ExpectRefused(const std::function<void()>& call, const std::string& part) {
    try {
      call();
      ADD_FAILURE() << "accepted what should be refused with: " << part;
    } catch (const Error& e) {
      EXPECT_TRUE(test::Says(e.what(), part));
    }
  }
  void ExpectRefused(const SolverArguments& arguments, const std::string& part) const {
    ExpectRefused([&] { const Solver solver(library, arguments); }, part);
  }

  const std::shared_ptr<const PluginLibrary> library = PluginLibrary::Load(PLUGIN_FILE);
  const std::int32_t world = MPI_Comm_c2f(MPI_COMM_WORLD);
  const int rank = communicator.rank();
  TwoDiskHost host;
};

TEST_F(Handles, WithoutAHost) {
  const Solver solver(library, {.solver = "nscdd", .options = {}, .host = nullptr, .communicator = world});
}

TEST_F(Handles, OneBadOption) {
  const std::string theta = rank == 1 ? "7" : "0.5";
  ExpectRefused({.solver = "nscdd", .options = {{"theta", theta}}, .host = nullptr, .communicator = world},
                "rank 1: option 'theta' is '7'");
}

TEST_F(Handles, OneSubdomainOnTwoRanks) {
  ExpectRefused({.solver = "nscd", .options = {}, .host = host.table(), .communicator = world}, "rank");
}

TEST_F(Handles, NoCommunicator) {
  ExpectRefused({.solver = "nscd", .options = {}, .host = nullptr, .communicator = MPI_Comm_c2f(MPI_COMM_NULL)},
                "no handle of this MPI");
}

TEST_F(Handles, OneQuestionAskedInTwoWays) {
  const std::string sweeps = rank == 1 ? "3" : "2";
  ExpectRefused({.solver = "nscdd", .options = {{"sweeps_per_stage", sweeps}}, .host = nullptr, .communicator = world},
                "rank 1: create: sweeps_per_stage = 3 here, but sweeps_per_stage = 2 on rank 0");
  ExpectRefused({.solver = rank == 1 ? "nscdd" : "fea", .options = {}, .host = nullptr, .communicator = world},
                "rank 1: create: solver = nscdd here");
  ExpectRefused({.solver = "nscdd",
                 .options = {{"subdomains", "2x1"}},
                 .host = rank == 0 ? host.table() : nullptr,
                 .communicator = world},
                "rank 1: create: host = none here");
}

// What only one rank does wrong is refused on both, and the next step succeeds.
TEST_F(Handles, OneBadCall) {
  reference::World bodies;
  if (rank == 0) {
    bodies.Add(reference::MakeDisk(1, {0.0, 0.0}, 0.5, 1000.0));
    bodies.Add(reference::MakeDisk(2, {0.9, 0.0}, 0.5, 1000.0));
  }
  reference::ReferenceAdapter adapter(&bodies);
  AdapterHost over_adapter(&adapter);
  Solver solver(library,
                {.solver = "nscdd", .options = {{"subdomains", "2x1"}}, .host = over_adapter.table(), .communicator = world});
  ExpectRefused([&] { solver.Step(rank == 1 ? std::nan("") : 0.01); }, "rank 1: the time step is nan s");
  ExpectRefused([&] { solver.Step(rank == 1 ? 0.02 : 0.01); }, "from 0.01 to 0.02 s");
  solver.Step(0.01);
  const std::vector<std::byte> state = solver.SaveState();
  ExpectRefused([&] { solver.LoadState(rank == 1 ? std::span<const std::byte>{} : state); }, "rank 1: load_state: the pointer");
  const std::array null{std::span<const std::byte>{}};
  ExpectRefused([&] { solver.LoadStates(rank == 1 ? null : std::array{std::span<const std::byte>(state)}); },
                "pointer to part 0");
  solver.Step(0.01);
  EXPECT_EQ(solver.Report().step, 2) << "a refused call counts as a step";
}

TEST_F(Handles, OneRankAloneStepsAsWithoutMpi) {
  TwoDiskHost alone;
  Solver over_self(library,
                   {.solver = "nscd", .options = {}, .host = host.table(), .communicator = MPI_Comm_c2f(MPI_COMM_SELF)});
  Solver serial(library, {.solver = "nscd", .options = {}, .host = alone.table(), .communicator = {}});
  for (int i = 0; i < 15; ++i) {
    over_self.Step(0.05);
    serial.Step(0.05);
  }
  EXPECT_EQ(host.pose(), alone.pose());
  EXPECT_EQ(host.commits(), 15);
}

}  // namespace
}  // namespace nscdd
