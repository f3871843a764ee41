// SPDX-License-Identifier: Apache-2.0
// Handles of the plugin over a communicator, on two ranks; exit code 0 when all of it holds.
#include <mpi.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include "nscdd/error.h"
#include "nscdd/host/adapter_host.h"
#include "nscdd/host/solver.h"
#include "nscdd/reference/reference_adapter.h"
#include "validator/two_disk_host.h"

namespace nscdd {
namespace {

int failures = 0;

void Check(bool holds, const std::string& what) {
  if (holds) return;
  ++failures;
  std::fprintf(stderr, "FAILED: %s\n", what.c_str());
}

void CheckRefused(const std::function<void()>& call, const std::string& part) {
  try {
    call();
    Check(false, "accepted what should be refused with: " + part);
  } catch (const Error& e) {
    Check(std::string(e.what()).find(part) != std::string::npos, "'" + part + "' is not in: " + e.what());
  }
}

void CheckRefused(const std::shared_ptr<const PluginLibrary>& library, const SolverArguments& arguments,
                  const std::string& part) {
  CheckRefused([&] { const Solver solver(library, arguments); }, part);
}

/// What only one rank does wrong is refused on both, and the next step succeeds.
void CheckOneBadCall(const std::shared_ptr<const PluginLibrary>& library, int rank) {
  reference::World world;
  if (rank == 0) {
    world.Add(reference::MakeDisk(1, {0.0, 0.0}, 0.5, 1000.0));
    world.Add(reference::MakeDisk(2, {0.9, 0.0}, 0.5, 1000.0));
  }
  reference::ReferenceAdapter adapter(&world);
  AdapterHost host(&adapter);
  Solver solver(library, {.solver = "nscdd",
                          .options = {{"subdomains", "2x1"}},
                          .host = host.table(),
                          .communicator = MPI_Comm_c2f(MPI_COMM_WORLD)});
  CheckRefused([&] { solver.Step(rank == 1 ? std::nan("") : 0.01); }, "rank 1: the time step is nan s");
  CheckRefused([&] { solver.Step(rank == 1 ? 0.02 : 0.01); }, "from 0.01 to 0.02 s");
  solver.Step(0.01);
  const std::vector<std::byte> state = solver.SaveState();
  CheckRefused([&] { solver.LoadState(rank == 1 ? std::span<const std::byte>{} : state); }, "rank 1: load_state: the pointer");
  const std::array null{std::span<const std::byte>{}};
  CheckRefused([&] { solver.LoadStates(rank == 1 ? null : std::array{std::span<const std::byte>(state)}); },
               "pointer to part 0");
  solver.Step(0.01);
  Check(solver.Report().step == 2, "a refused call counts as a step");
}

void Run(const char* path, int rank) {
  const auto library = PluginLibrary::Load(path);
  const std::int32_t world = MPI_Comm_c2f(MPI_COMM_WORLD), self = MPI_Comm_c2f(MPI_COMM_SELF);
  TwoDiskHost host;
  { const Solver solver(library, {.solver = "nscdd", .options = {}, .host = nullptr, .communicator = world}); }
  // An error on one rank is the same sentence on both, and nobody waits.
  const std::string theta = rank == 1 ? "7" : "0.5";
  CheckRefused(library, {.solver = "nscdd", .options = {{"theta", theta}}, .host = nullptr, .communicator = world},
               "rank 1: option 'theta' is '7'");
  CheckRefused(library, {.solver = "nscd", .options = {}, .host = host.table(), .communicator = world}, "rank");
  CheckRefused(library, {.solver = "nscd", .options = {}, .host = nullptr, .communicator = MPI_Comm_c2f(MPI_COMM_NULL)},
               "no handle of this MPI");
  // So is the same question asked in two ways.
  const std::string sweeps = rank == 1 ? "3" : "2";
  CheckRefused(library, {.solver = "nscdd", .options = {{"sweeps_per_stage", sweeps}}, .host = nullptr, .communicator = world},
               "rank 1: create: sweeps_per_stage = 3 here, but sweeps_per_stage = 2 on rank 0");
  CheckRefused(library, {.solver = rank == 1 ? "nscdd" : "fea", .options = {}, .host = nullptr, .communicator = world},
               "rank 1: create: solver = nscdd here");
  CheckRefused(library,
               {.solver = "nscdd",
                .options = {{"subdomains", "2x1"}},
                .host = rank == 0 ? host.table() : nullptr,
                .communicator = world},
               "rank 1: create: host = none here");
  CheckOneBadCall(library, rank);
  // One rank alone steps as without MPI.
  TwoDiskHost alone;
  Solver over_self(library, {.solver = "nscd", .options = {}, .host = host.table(), .communicator = self});
  Solver serial(library, {.solver = "nscd", .options = {}, .host = alone.table(), .communicator = {}});
  for (int i = 0; i < 15; ++i) {
    over_self.Step(0.05);
    serial.Step(0.05);
  }
  Check(host.pose() == alone.pose() && host.commits() == 15, "MPI_COMM_SELF gives other results than no MPI");
}

}  // namespace
}  // namespace nscdd

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    nscdd::Run(argv[1], rank);
  } catch (const std::exception& e) {
    nscdd::Check(false, e.what());
  }
  MPI_Finalize();
  return nscdd::failures == 0 ? 0 : 1;
}
