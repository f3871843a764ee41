// SPDX-License-Identifier: Apache-2.0
#include "parallel/mpi_handle.h"

#include "nscdd/mpi_communicator.h"

namespace nscdd {

std::optional<int> FortranHandleOf(const Communicator& communicator) {
  const auto* mpi = dynamic_cast<const MpiCommunicator*>(&communicator);
  if (mpi == nullptr) return {};
  return static_cast<int>(MPI_Comm_c2f(mpi->handle()));
}

int SelfFortranHandle() { return static_cast<int>(MPI_Comm_c2f(MPI_COMM_SELF)); }

bool IsMpiInitialised() {
  int on = 0, off = 0;
  MPI_Initialized(&on);
  MPI_Finalized(&off);
  return on && !off;
}

}  // namespace nscdd
