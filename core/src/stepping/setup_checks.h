// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"

namespace nscdd {

/// Asks the adapter who it is. Throws Error on options that make no sense, on a period far from its origin, on more `ranks`
/// than subdomains, and on several ranks with an adapter that cannot move bodies between them.
AdapterDescription CheckSetup(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter,
                              int ranks);

/// Throws Error unless `dt` [s] is positive and finite.
void CheckTimeStep(double dt);

}  // namespace nscdd
