// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "nscdd/vector.h"

namespace nscdd {

/// Bodies on their way through a step of `dt` [s]: at time t dt body i is at Moved(pose[i], velocity[i], t dt), t in [0, 1].
/// Four columns, rows in ascending order of id.
struct MotionView {
  std::span<const std::int64_t> id;
  std::span<const Pose> pose;       ///< at the beginning of the step
  std::span<const Twist> velocity;  ///< [m/s, rad/s]
  std::span<const double> reach;    ///< [m] how far any point of the body may come in the step (half-planes that turn excepted)
  double dt = 0.0;
};

/// Largest sum of two reaches [m].
inline double LargestReach(const MotionView& motion) {
  double first = 0.0, second = 0.0;
  for (const double reach : motion.reach) {
    second = std::max(second, std::min(first, reach));
    first = std::max(first, reach);
  }
  return first + second;
}

}  // namespace nscdd
