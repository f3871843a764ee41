// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/vector.h"
#include "render/drawing.h"

namespace nscdd {

/// Where things go: a title band above, the world in the middle (equal aspect), scale and legend in a band below.
struct Layout {
  int width = 0;  ///< [pixels]
  int height = 0;
  double font = 0.0;  ///< size of ordinary text [pixels]
  double margin = 0.0;
  double scale = 0.0;        ///< pixels per metre
  Vec2 corner;               ///< upper left of the world's rectangle
  double world_width = 0.0;  ///< [pixels]
  double world_height = 0.0;
  double band_top = 0.0;  ///< of the band below
  Box box;

  Vec2 ToPixels(Vec2 point) const {
    return {corner.x + scale * (point.x - box.low.x), corner.y + scale * (box.high.y - point.y)};
  }
};

/// Grains get about 26 pixels of diameter if the picture then stays between 700 and 2000 pixels.
Layout MakeLayout(const Drawing& drawing);

}  // namespace nscdd
