// SPDX-License-Identifier: Apache-2.0
#include "scene/gravity.h"

#include <algorithm>
#include <cmath>

namespace nscdd {
namespace {

struct Evaluate {
  std::int64_t step;
  double time;

  Vec2 operator()(const ConstantGravity& law) const { return law.vector; }

  Vec2 operator()(const RotatingGravity& law) const {
    const double share =
        law.in_steps ? static_cast<double>(step - 1) / static_cast<double>(*law.in_steps - 1) : time / law.in_time;
    const double angle = share < 1.0 ? law.from_angle + (law.to_angle - law.from_angle) * share : law.to_angle;
    return {law.g * std::sin(angle), -law.g * std::cos(angle)};
  }

  Vec2 operator()(const GravityTable& law) const {
    const auto after = std::upper_bound(law.samples.begin(), law.samples.end(), time,
                                        [](double t, const GravitySample& sample) { return t < sample.time; });
    if (after == law.samples.begin()) return after->vector;
    const auto before = after - 1;
    if (after == law.samples.end()) return before->vector;
    const double share = (time - before->time) / (after->time - before->time);
    return before->vector + share * (after->vector - before->vector);
  }
};

}  // namespace

Vec2 GravityAt(const GravityLaw& law, std::int64_t k, double dt, const RunClock& start) {
  const std::int64_t step = start.step + k;
  return std::visit(Evaluate{step, start.TimeOf(step - 1, dt)}, law);
}

}  // namespace nscdd
