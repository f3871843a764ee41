// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "nscdd/vector.h"
#include "results/result_tables.h"

namespace nscdd {

/// A disk of a body, where it is in the world.
struct PlacedDisk {
  std::size_t grain;  ///< row in Drawing::grains
  Vec2 centre;
  double radius;
};

/// A segment, or the border of a half-plane, of a body.
struct PlacedLine {
  std::size_t grain;
  Vec2 from;
  Vec2 to;
  bool is_half_plane;  ///< endless, solid to its right
};

/// A contact from the centre of A's disk to the centre of B's (the point of contact, on a side without disk).
struct PlacedContact {
  Vec2 from;
  Vec2 to;
  double impulse;  ///< normal [N s]
  double overlap;  ///< max(0, -final_gap) [m]
};

/// Rectangle in the world [m].
struct Box {
  Vec2 low{1e300, 1e300};
  Vec2 high{-1e300, -1e300};

  double width() const { return high.x - low.x; }
  double height() const { return high.y - low.y; }
  bool is_empty() const { return high.x < low.x; }
  void Include(Vec2 point, double around);
};

/// A saved step in world coordinates, ready to be drawn.
struct Drawing {
  RunDescription run;
  StepDescription step;
  GrainTable grains;              ///< by ascending id
  std::vector<PlacedDisk> disks;  ///< by grain
  std::vector<PlacedLine> lines;
  std::vector<PlacedContact> contacts;
  Box box;  ///< what the picture shows

  bool IsFree(std::size_t grain) const { return grains.kind[grain] == 0; }
  double Speed(std::size_t grain) const { return Norm({grains.vx[grain], grains.vy[grain]}); }
};

/// Reads a saved step, by default the last one. Throws Error as ResultsReader does, and when no step was saved.
Drawing ReadDrawing(const std::filesystem::path& folder, std::optional<std::int64_t> step);

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
