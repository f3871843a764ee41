// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "nscdd/vector.h"

namespace nscdd::contact_law {

/// Numbers that depend on the seed alone: the standard's distributions differ between libraries, its generators do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double Uniform(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
  double LogUniform(double low, double high) { return std::exp(Uniform(std::log(low), std::log(high))); }
  int Below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  bool Chance(double probability) { return Uniform(0.0, 1.0) < probability; }
  double Sign() { return Chance(0.5) ? 1.0 : -1.0; }
  Vec2 Direction() { return Rotate(Uniform(-3.14159265358979, 3.14159265358979), {1.0, 0.0}); }
  template <class T, std::size_t N>
  T OneOf(const T (&choices)[N]) {
    return choices[Below(static_cast<int>(N))];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace nscdd::contact_law
