// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "nscdd/communicator.h"

namespace nscdd {

/// Fortran handle of a communicator over MPI; none for any other.
std::optional<int> FortranHandleOf(const Communicator& communicator);

/// Fortran handle of MPI_COMM_SELF.
int SelfFortranHandle();

bool IsMpiInitialised();

}  // namespace nscdd
