// SPDX-License-Identifier: Apache-2.0
#include "render/paint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nscdd {
namespace {

constexpr double kOutlinedRadius = 3.0;  // [pixels]
constexpr double kTickRadius = 4.0;

/// Calls `draw(centre)` [m] for a circle and for its periodic images that reach into the picture.
template <class Draw>
void ForEachImage(const Drawing& drawing, Vec2 centre, double radius, Draw draw) {
  const double period = drawing.run.period;
  for (int image = period > 0.0 ? -1 : 0; image <= (period > 0.0 ? 1 : 0); ++image) {
    const Vec2 shifted{centre.x + image * period, centre.y};
    const bool inside = shifted.x + radius >= drawing.box.low.x && shifted.x - radius <= drawing.box.high.x &&
                        shifted.y + radius >= drawing.box.low.y && shifted.y - radius <= drawing.box.high.y;
    if (inside) draw(shifted);
  }
}

/// Ends of an endless line, far outside the picture.
std::pair<Vec2, Vec2> FarEnds(const PlacedLine& line, const Box& box) {
  const Vec2 along = (1.0 / Norm(line.to - line.from)) * (line.to - line.from);
  const Vec2 middle = 0.5 * (box.low + box.high);
  const Vec2 foot = line.from + Dot(middle - line.from, along) * along;
  const double far = 2.0 * (box.width() + box.height());
  return {foot - far * along, foot + far * along};
}

void MoveAlong(const Layout& layout, Vec2 from, Vec2 to, cairo_t* context) {
  const Vec2 a = layout.ToPixels(from), b = layout.ToPixels(to);
  cairo_move_to(context, a.x, a.y);
  cairo_line_to(context, b.x, b.y);
}

}  // namespace

void PaintHalfPlanes(const Drawing& drawing, const Layout& layout, Picture* picture) {
  cairo_t* context = picture->context();
  for (const PlacedLine& line : drawing.lines) {
    if (!line.is_half_plane) continue;
    const auto [from, to] = FarEnds(line, drawing.box);
    const Vec2 across = to - from;
    const Vec2 solid{across.y, -across.x};  // to the right of the direction
    MoveAlong(layout, from, to, context);
    const Vec2 c = layout.ToPixels(to + solid), d = layout.ToPixels(from + solid);
    cairo_line_to(context, c.x, c.y);
    cairo_line_to(context, d.x, d.y);
    cairo_close_path(context);
    picture->SetColour(kSolid);
    cairo_fill(context);
  }
}

void PaintDisks(const Drawing& drawing, const Layout& layout, const std::function<Colour(std::size_t)>& colour,
                Picture* picture) {
  cairo_t* context = picture->context();
  for (const PlacedDisk& disk : drawing.disks) {
    const Colour fill = drawing.IsFree(disk.grain) ? colour(disk.grain) : kWall;
    const double radius = std::max(0.5, layout.scale * disk.radius);
    ForEachImage(drawing, disk.centre, disk.radius, [&](Vec2 centre) {
      const Vec2 at = layout.ToPixels(centre);
      cairo_arc(context, at.x, at.y, radius, 0.0, 2.0 * std::numbers::pi);
      picture->SetColour(fill);
      if (radius < kOutlinedRadius) {
        cairo_fill(context);
        return;
      }
      cairo_fill_preserve(context);
      picture->SetColour({0.55 * fill.red, 0.55 * fill.green, 0.55 * fill.blue});
      cairo_set_line_width(context, std::clamp(0.05 * radius, 0.5, 2.0));
      cairo_stroke(context);
    });
  }
}

void PaintTicks(const Drawing& drawing, const Layout& layout, Picture* picture) {
  cairo_t* context = picture->context();
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  for (const PlacedDisk& disk : drawing.disks) {
    const double radius = layout.scale * disk.radius;
    if (!drawing.IsFree(disk.grain) || radius < kTickRadius) continue;
    const Vec2 tip = Rotate(drawing.grains.angle[disk.grain], {0.85 * disk.radius, 0.0});
    ForEachImage(drawing, disk.centre, disk.radius, [&](Vec2 centre) {
      // White on a dark rim: seen on every colour.
      MoveAlong(layout, centre, centre + tip, context);
      picture->SetColour({0.0, 0.0, 0.0}, 0.55);
      cairo_set_line_width(context, std::clamp(0.22 * radius, 1.6, 6.0));
      cairo_stroke_preserve(context);
      picture->SetColour({1.0, 1.0, 1.0});
      cairo_set_line_width(context, std::clamp(0.10 * radius, 0.8, 3.0));
      cairo_stroke(context);
    });
  }
}

void PaintLines(const Drawing& drawing, const Layout& layout, Picture* picture) {
  cairo_t* context = picture->context();
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, std::max(1.5, layout.font / 8.0));
  picture->SetColour(kInk);
  for (const PlacedLine& line : drawing.lines) {
    const auto [from, to] = line.is_half_plane ? FarEnds(line, drawing.box) : std::pair(line.from, line.to);
    MoveAlong(layout, from, to, context);
    cairo_stroke(context);
  }
}

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
