// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace nscdd {

/// SplitMix64's finaliser: the same on every machine and standard library.
constexpr std::uint64_t MixBits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// Number `index` of the sequence `seed`, uniform in [0, 1); any of them without the ones before.
constexpr double UniformNumber(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t bits = MixBits(MixBits(seed) + (index + 1) * 0x9E3779B97F4A7C15u);
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

}  // namespace nscdd
