// Handles of the plugin over a communicator, on two ranks; exit code 0 when all of it holds.
#include <mpi.h>

#include <cstdio>

#include "nscdd/error.h"
#include "nscdd/host/solver.h"
#include "validator/two_disk_host.h"

namespace nscdd {
namespace {

int failures = 0;

void Check(bool holds, const std::string& what) {
  if (holds) return;
  ++failures;
  std::fprintf(stderr, "FAILED: %s\n", what.c_str());
}

void CheckRefused(const std::shared_ptr<const PluginLibrary>& library, const SolverArguments& arguments,
                  const std::string& part) {
  try {
    const Solver solver(library, arguments);
    Check(false, "create accepted what should be refused with: " + part);
  } catch (const Error& e) {
    Check(std::string(e.what()).find(part) != std::string::npos, "'" + part + "' is not in: " + e.what());
  }
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
