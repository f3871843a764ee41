// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include "nscdd/mpi_communicator.h"

namespace nscdd::test {

/// Calls f(communicator) on the first `ranks` ranks of MPI_COMM_WORLD. Collective over all of them.
template <class F>
void OnFirstRanks(int ranks, F f) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm part;
  MPI_Comm_split(MPI_COMM_WORLD, rank < ranks ? 0 : MPI_UNDEFINED, rank, &part);
  if (part == MPI_COMM_NULL) return;
  {
    MpiCommunicator communicator(part);
    f(&communicator);
  }
  MPI_Comm_free(&part);
}

}  // namespace nscdd::test
