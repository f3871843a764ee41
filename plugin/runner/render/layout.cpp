// SPDX-License-Identifier: Apache-2.0
#include "render/layout.h"

#include <algorithm>
#include <cmath>

namespace nscdd {
namespace {

constexpr double kGrainDiameter = 26.0;  // [pixels]
constexpr double kSmallest = 700.0;
constexpr double kLargest = 2000.0;
constexpr double kNarrowest = 820.0;  // width that title and legend need

}  // namespace

Layout MakeLayout(const Drawing& drawing) {
  Layout layout;
  layout.box = drawing.box;
  const double longer = std::max(layout.box.width(), layout.box.height());
  const double diameter = 2.0 * drawing.step.mean_radius;
  const double wanted = diameter > 0.0 ? kGrainDiameter * longer / diameter : kSmallest;
  const double pixels = std::clamp(wanted, kSmallest, kLargest);
  layout.scale = pixels / longer;
  layout.world_width = layout.scale * layout.box.width();
  layout.world_height = layout.scale * layout.box.height();

  const double content = std::max(kNarrowest, layout.world_width);
  layout.font = std::clamp(content / 62.0, 15.0, 30.0);
  layout.margin = 1.5 * layout.font;
  layout.width = static_cast<int>(std::ceil(content + 2.0 * layout.margin));
  const double title = 3.6 * layout.font, band = 5.2 * layout.font;
  layout.corner = {(layout.width - layout.world_width) / 2.0, layout.margin + title};
  layout.band_top = layout.corner.y + layout.world_height + layout.font;
  layout.height = static_cast<int>(std::ceil(layout.band_top + band));
  return layout;
}

}  // namespace nscdd
