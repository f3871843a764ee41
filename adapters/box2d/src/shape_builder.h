// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/box2d/exact_body.h"
#include "shape.h"

class b2Body;

namespace nscdd::box2d {

/// A shape and its wall, before they are stored.
struct ShapeDraft {
  Shape shape;
  Wall wall;  // unused by disks
};

/// Shapes of the body's fixtures in order of creation, children of chains one by one, in the frame of the centre of mass.
std::vector<ShapeDraft> DraftShapes(const b2Body& body, double scale);

/// Replaces what the fixtures say in float. Throws Error that names body `id` if their number, kind or place is not the same
/// (to 1e-4 of their size).
void ApplyExact(const std::vector<ExactShape>& exact, std::int64_t id, std::vector<ShapeDraft>* drafts);

/// The same numbers as an ExactShape.
ExactShape ExactOf(const Shape& shape, const Wall* wall);

}  // namespace nscdd::box2d
