// SPDX-License-Identifier: Apache-2.0
#include "mpi_session.h"

#include <mpi.h>

#include <cstdlib>

namespace nscdd {
namespace {

/// What Open MPI, MPICH and Slurm set in the environment of the processes that they start.
bool IsLaunched() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"}) {
    if (std::getenv(variable) != nullptr) return true;
  }
  return false;
}

}  // namespace

MpiSession::MpiSession(int* argc, char*** argv) : on_(IsLaunched()) {
  if (!on_) return;
  MPI_Init(argc, argv);
  MPI_Comm own, solver;
  MPI_Comm_dup(MPI_COMM_WORLD, &own);
  MPI_Comm_dup(MPI_COMM_WORLD, &solver);
  ranks_ = RankGroup(own);
  solver_ = static_cast<std::int32_t>(MPI_Comm_c2f(solver));
}

MpiSession::~MpiSession() {
  if (on_) MPI_Finalize();
}

void MpiSession::Abort(int code) const {
  if (on_) MPI_Abort(MPI_COMM_WORLD, code);
  std::exit(code);
}

}  // namespace nscdd
