// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "nscdd/body_table.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// Copies what a host's read_bodies gave. Throws Error, naming `who` and the body, on null arrays, absurd counts, negative or
/// repeated ids and unknown kinds. Whether the numbers make sense is left to the core, which checks every adapter's tables.
void CopyBodies(const nscdd_bodies& source, const std::string& who, BodyTable* bodies);

}  // namespace nscdd
