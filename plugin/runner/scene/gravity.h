// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd {

/// Where a run is, or several that follow each other.
struct RunClock {
  std::int64_t step = 0;        ///< steps done
  double time = 0.0;            ///< [s] sum of their time steps
  std::int64_t even_since = 0;  ///< all steps behind this one have had the same length; it ended at `even_time`
  double even_time = 0.0;       ///< [s]

  /// [s] when step `k` > even_since ends, if steps go on with length `dt`; a product, so that rounding does not add up.
  double TimeOf(std::int64_t k, double dt) const { return even_time + static_cast<double>(k - even_since) * dt; }
};

struct ConstantGravity {
  Vec2 vector{0.0, -9.81};  ///< [m/s^2]
  double angle = 0.0;       ///< [rad] from which it was made; 0 if it was given itself
};

/// g (sin a, -cos a); the angle goes linearly from `from_angle` at the first step to `to_angle`, then stays.
struct RotatingGravity {
  double g = 9.81;                       ///< [m/s^2]
  double from_angle = 0.0;               ///< [rad]
  double to_angle = 0.0;                 ///< [rad]
  std::optional<std::int64_t> in_steps;  ///< the step (from 1) that is the first with `to_angle`; >= 2
  double in_time = 0.0;                  ///< [s] otherwise: the time at whose step the angle has arrived
};

struct GravitySample {
  double time;  ///< [s]
  Vec2 vector;  ///< [m/s^2]
};

/// Linear between samples (ascending in time), constant before the first and after the last.
struct GravityTable {
  std::vector<GravitySample> samples;
};

using GravityLaw = std::variant<ConstantGravity, RotatingGravity, GravityTable>;

/// Gravity [m/s^2] during the k-th step, k >= 1, of `dt` [s] behind `start`: its value at the beginning of the step.
Vec2 GravityAt(const GravityLaw& law, std::int64_t k, double dt, const RunClock& start = {});

}  // namespace nscdd
