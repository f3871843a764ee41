// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/options.h"

namespace nscdd {

/// Throws Error, naming the option, its value and what is allowed.
void CheckStepping(const SteppingOptions& options);
void CheckAlgorithm(const AlgorithmOptions& algorithm);

}  // namespace nscdd
