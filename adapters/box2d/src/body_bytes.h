// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/box2d/exact_body.h"

namespace nscdd::box2d {

/// Appends the id, all that makes the b2Body and its fixtures (user data excepted), its load, and its double-precision master.
void AppendBytes(const b2Body& body, std::int64_t id, const ExactBody& exact, const Wrench& added_load,
                 std::vector<std::byte>* bytes);

struct InsertedBody {
  b2Body* body;
  ExactBody exact;
  Wrench added_load;
};

/// Makes the body in `world`. Throws Error, and then did nothing, if the bytes are not of AppendBytes or of another id.
InsertedBody MakeBody(std::span<const std::byte> bytes, std::int64_t id, b2World* world);

}  // namespace nscdd::box2d
