// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "nscdd/communicator.h"

namespace nscdd {

/// Runs `work` on every rank. If it throws on some, the same Error is thrown on all: the sentence of the lowest failing rank,
/// which is named when there are several. Collective; with one rank it is a plain call.
void RunTogether(Communicator* communicator, const std::function<void()>& work);

}  // namespace nscdd
