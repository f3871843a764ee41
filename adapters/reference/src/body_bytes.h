// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nscdd/reference/world.h"

namespace nscdd::reference {

/// Appends the body to `bytes`, numbers as they lie in memory: for ranks of one run, not for files.
void AppendBytes(const Body& body, std::vector<std::byte>* bytes);

/// Reads what AppendBytes wrote. Throws Error if it is anything else.
Body BodyFromBytes(std::span<const std::byte> bytes);

}  // namespace nscdd::reference
