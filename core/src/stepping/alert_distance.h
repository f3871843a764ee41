// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/body_table.h"
#include "nscdd/communicator.h"

namespace nscdd {

/// A tenth of the mean disk radius of all ranks' free bodies [m], each on one rank; negative while there are none. Collective.
/// Radii are summed as multiples of 2^-26 of the largest: exact in any order, so the same on any number of ranks.
double DefaultAlertDistance(const BodyTable& bodies, Communicator* communicator);

}  // namespace nscdd
