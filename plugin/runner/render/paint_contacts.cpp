// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "render/paint.h"

namespace nscdd {
namespace {

/// A line in the world and, where there is a period, its images; those outside are clipped.
void Stroke(const Drawing& drawing, const Layout& layout, Vec2 from, Vec2 to, cairo_t* context) {
  const double period = drawing.run.period;
  for (int image = period > 0.0 ? -1 : 0; image <= (period > 0.0 ? 1 : 0); ++image) {
    const Vec2 shift{image * period, 0.0};
    const Vec2 a = layout.ToPixels(from + shift), b = layout.ToPixels(to + shift);
    if (std::max(a.x, b.x) < 0.0 || std::min(a.x, b.x) > layout.width) continue;
    cairo_move_to(context, a.x, a.y);
    cairo_line_to(context, b.x, b.y);
    cairo_stroke(context);
  }
}

}  // namespace

double LargestChainWidth(const Drawing& drawing, const Layout& layout) {
  return std::clamp(1.1 * drawing.step.mean_radius * layout.scale, 4.0, 26.0);
}

void PaintForces(const Drawing& drawing, const Layout& layout, double full_impulse, Picture* picture) {
  cairo_t* context = picture->context();
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  picture->SetColour(kChain);
  const double full_width = LargestChainWidth(drawing, layout);
  for (const PlacedContact& contact : drawing.contacts) {
    const double width = full_width * std::min(1.0, contact.impulse / full_impulse);
    if (!(width > 0.05)) continue;  // nothing to see; also open contacts
    cairo_set_line_width(context, width);
    Stroke(drawing, layout, contact.from, contact.to, context);
  }
}

void PaintOverlaps(const Drawing& drawing, const Layout& layout, double threshold, Picture* picture) {
  cairo_t* context = picture->context();
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, std::clamp(0.35 * drawing.step.mean_radius * layout.scale, 4.0, 14.0));
  picture->SetColour(kOverlapRed);
  const double shortest = 12.0 / layout.scale;  // few of 100 000 grains must still be found
  for (const PlacedContact& contact : drawing.contacts) {
    if (contact.overlap < threshold) continue;
    const Vec2 along = contact.to - contact.from, middle = 0.5 * (contact.from + contact.to);
    const double length = Norm(along);
    const Vec2 half = length > 0.0 ? (0.5 * std::max(1.0, shortest / length)) * along : Vec2{0.5 * shortest, 0.0};
    Stroke(drawing, layout, middle - half, middle + half, context);
  }
}

}  // namespace nscdd
