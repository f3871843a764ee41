// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include <memory>

#include "byte_stream.h"

namespace nscdd::box2d {

/// A fixture without its body.
struct Fixture {
  std::unique_ptr<b2Shape> shape;
  b2FixtureDef def;
};

/// Shape, material and filter; user data stay behind.
void PutFixture(const b2Fixture& fixture, Writer* out);
Fixture GetFixture(Reader* in);

}  // namespace nscdd::box2d
