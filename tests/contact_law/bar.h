// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <exception>
#include <string>
#include <type_traits>

#include "random.h"
#include "scene.h"

namespace nscdd::contact_law {

using Platforms = testing::Types<ReferenceScene, Box2dScene>;

struct PlatformNames {
  template <class S>
  static std::string GetName(int) {
    return std::is_same_v<S, ReferenceScene> ? "Reference" : "Box2d";
  }
};

/// Runs `trial(Random&)` for `count` seeds from `first_seed` on; a trial returns what is wrong, or nothing. At most `most` may
/// fail.
template <class Trial>
testing::AssertionResult FewOf(int most, int count, std::uint64_t first_seed, const Trial& trial) {
  int failed = 0;
  std::string told;
  for (int k = 0; k < count; ++k) {
    Random random(first_seed + static_cast<std::uint64_t>(k));
    std::string wrong;
    try {
      wrong = trial(random);
    } catch (const std::exception& error) {
      wrong = fmt::format("threw: {}", error.what());
    }
    if (wrong.empty()) continue;
    if (++failed <= 5) told += fmt::format("\n  seed {}: {}", first_seed + static_cast<std::uint64_t>(k), wrong);
  }
  if (failed <= most) return testing::AssertionSuccess();
  return testing::AssertionFailure() << fmt::format("{} of {} fail; the first:{}", failed, count, told);
}

template <class Trial>
testing::AssertionResult NoneOf(int count, std::uint64_t first_seed, const Trial& trial) {
  return FewOf(0, count, first_seed, trial);
}

/// NSCD that solves to rounding.
inline NscdOptions Exact(double tolerance = 1e-13) {
  NscdOptions options;
  options.stopping.tolerance = tolerance;
  options.stopping.max_iterations = 20000;
  options.stopping.test_every = 1;
  return options;
}

}  // namespace nscdd::contact_law
