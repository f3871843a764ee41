// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace nscdd {

/// Red, green, blue in [0, 1].
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

inline constexpr Colour kInk{0.13, 0.13, 0.15};
inline constexpr Colour kWall{0.42, 0.43, 0.46};
inline constexpr Colour kSolid{0.86, 0.86, 0.88};  ///< behind half-planes
inline constexpr Colour kPale{0.90, 0.91, 0.93};   ///< grains behind something else
inline constexpr Colour kChain{0.07, 0.20, 0.45};
inline constexpr Colour kOverlapRed{0.86, 0.05, 0.08};

/// Viridis at `value` in [0, 1]: equal steps look equal, also in grey and to the colour blind.
Colour SpeedColour(double value);

/// Multiplicities from here on share a colour.
inline constexpr std::int32_t kLargestMultiplicityColour = 6;

/// 0 (no contact) nearly white, 1 grey, 2 dark, corners in colours.
Colour MultiplicityColour(std::int32_t multiplicity);

}  // namespace nscdd
