// SPDX-License-Identifier: Apache-2.0
#include "render/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nscdd {
namespace {

constexpr std::array<Colour, 9> kViridis = {{{0.267, 0.005, 0.329},
                                             {0.279, 0.175, 0.483},
                                             {0.230, 0.322, 0.546},
                                             {0.173, 0.449, 0.558},
                                             {0.128, 0.567, 0.551},
                                             {0.158, 0.684, 0.502},
                                             {0.369, 0.789, 0.383},
                                             {0.678, 0.864, 0.190},
                                             {0.993, 0.906, 0.144}}};

constexpr std::array<Colour, kLargestMultiplicityColour + 1> kMultiplicities = {{{0.96, 0.96, 0.96},
                                                                                 {0.80, 0.80, 0.80},
                                                                                 {0.27, 0.28, 0.31},
                                                                                 {0.90, 0.56, 0.00},
                                                                                 {0.00, 0.45, 0.75},
                                                                                 {0.84, 0.20, 0.20},
                                                                                 {0.55, 0.20, 0.65}}};

}  // namespace

Colour SpeedColour(double value) {
  const double position = std::clamp(value, 0.0, 1.0) * (kViridis.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(position), kViridis.size() - 2);
  const double t = position - static_cast<double>(i);
  const Colour a = kViridis[i], b = kViridis[i + 1];
  return {std::lerp(a.red, b.red, t), std::lerp(a.green, b.green, t), std::lerp(a.blue, b.blue, t)};
}

Colour MultiplicityColour(std::int32_t multiplicity) {
  return kMultiplicities[static_cast<std::size_t>(std::clamp(multiplicity, 0, kLargestMultiplicityColour))];
}

}  // namespace nscdd
