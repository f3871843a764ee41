// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdio>

#include "scene/scene.h"

namespace nscdd {

/// One line each, on stderr; on one rank.
inline void PrintNotes(const Notes& notes) {
  for (const std::string& sentence : notes.sentences) fmt::print(stderr, "nscdd: note: {}\n", sentence);
}

}  // namespace nscdd
