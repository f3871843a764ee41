// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/drawing.h"
#include "render/picture.h"
#include "render/render.h"

namespace nscdd {

// The layers of a picture, from back to front. World layers are clipped to the world's rectangle.

/// Solid sides of half-planes.
void PaintHalfPlanes(const Drawing& drawing, const Layout& layout, Picture* picture);
/// Disks in the colour of their grain, outlined where they are large enough to be told apart.
void PaintDisks(const Drawing& drawing, const Layout& layout, const std::function<Colour(std::size_t grain)>& colour,
                Picture* picture);
/// Radii that show the angles of free bodies, where they are large enough.
void PaintTicks(const Drawing& drawing, const Layout& layout, Picture* picture);
/// Segments and borders of half-planes.
void PaintLines(const Drawing& drawing, const Layout& layout, Picture* picture);

/// Largest width [pixels] of a line.
double LargestChainWidth(const Drawing& drawing, const Layout& layout);
/// Widths are proportional to the impulse, up to the largest width at `full_impulse` [N s].
void PaintForces(const Drawing& drawing, const Layout& layout, double full_impulse, Picture* picture);
/// Contacts that overlap by at least `threshold` [m].
void PaintOverlaps(const Drawing& drawing, const Layout& layout, double threshold, Picture* picture);

/// An entry of the legend: a patch of colour, or a line of that width, and what it means.
struct LegendEntry {
  Colour colour;
  double line_width = 0.0;  ///< [pixels]; 0: a patch
  std::string text;
};

void PaintTitle(const Layout& layout, const std::string& title, const std::string& subtitle, Picture* picture);
void PaintScaleBar(const Layout& layout, Picture* picture);
void PaintLegend(const Layout& layout, const std::vector<LegendEntry>& entries, Picture* picture);
/// Colour bar of speeds from 0 to `largest` [m/s].
void PaintSpeedBar(const Layout& layout, double largest, Picture* picture);

}  // namespace nscdd
