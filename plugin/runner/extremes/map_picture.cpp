// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "extremes/extreme_map.h"
#include "render/picture.h"

namespace nscdd {
namespace {

constexpr int kRow = 17, kColumn = 108, kNames = 330, kTop = 60, kFont = 11, kLegend = 90;
constexpr int kSmallest = -14;  // decades of the colour scale: 1e-14 to 1

/// Bright where the error is small.
Colour ErrorColour(double error) {
  const double decade = error > 0.0 ? std::log10(error) : kSmallest;
  return SpeedColour(std::clamp(decade / kSmallest, 0.0, 1.0));
}

Colour CellColour(const Outcome& o) {
  switch (o.verdict) {
    case Verdict::kNone:
      return {1.0, 1.0, 1.0};
    case Verdict::kRefused:
      return kPale;
    case Verdict::kSilent:
    case Verdict::kBroken:
      return kOverlapRed;
    case Verdict::kHolds:
    case Verdict::kLimit:
      break;
  }
  return ErrorColour(o.error);
}

void DrawCell(const Outcome& o, Vec2 corner, Picture* picture) {
  const Colour colour = CellColour(o);
  picture->SetColour(colour);
  picture->FillRectangle(corner, kColumn - 2.0, kRow - 2.0);
  const bool dark = 0.3 * colour.red + 0.6 * colour.green + 0.1 * colour.blue < 0.5;
  picture->SetColour(dark ? Colour{1.0, 1.0, 1.0} : kInk);
  const std::string text = o.verdict == Verdict::kNone      ? ""
                           : o.verdict == Verdict::kRefused ? "R"
                                                            : fmt::format("{} {:.0e}  {}", MarkOf(o), o.error, o.iterations);
  picture->Text({corner.x + 4.0, corner.y + kRow - 5.0}, text, kFont - 1.0);
}

void DrawLegend(double top, Picture* picture) {
  picture->SetColour(kInk);
  picture->Text({10.0, top + 16.0},
                "Cell: how it ended, largest error of a velocity over the scene's natural speed, iterations.", kFont);
  picture->Text({10.0, top + 32.0},
                ". converged   I incomplete   L iteration limit   S stalled   D diverged   W converged, and a sentence warns   "
                "R refused   red: wrong without a word",
                kFont);
  for (int decade = kSmallest; decade <= 0; ++decade) {
    const Vec2 corner{10.0 + 52.0 * (decade - kSmallest), top + 44.0};
    const Colour colour = ErrorColour(std::pow(10.0, decade));
    picture->SetColour(colour);
    picture->FillRectangle(corner, 52.0, 16.0);
    picture->SetColour(kInk);
    picture->Text({corner.x + 4.0, corner.y + 30.0}, fmt::format("1e{}", decade), kFont - 1.0);
  }
}

}  // namespace

void DrawMap(const ExtremeMap& map, const std::filesystem::path& file) {
  const auto rows = static_cast<int>(map.cases.size()), columns = static_cast<int>(map.columns.size());
  Picture picture(file, std::max(kNames + kColumn * columns + 10, 820), kTop + kRow * rows + kLegend);
  picture.SetColour(kInk);
  picture.Text({10.0, 22.0}, "Where each solver holds", 15.0, 0.0, true);
  for (int k = 0; k < columns; ++k) {
    picture.SetColour(kInk);
    picture.Text({kNames + k * kColumn + 4.0, kTop - 8.0}, map.columns[k].name, kFont, 0.0, true);
  }
  for (int i = 0; i < rows; ++i) {
    const double y = kTop + i * kRow;
    const ExtremeCase& c = map.cases[i];
    const bool first = i == 0 || map.cases[i - 1].family != c.family;
    picture.SetColour(kInk);
    if (first) picture.Text({10.0, y + kRow - 5.0}, c.family, kFont, 0.0, true);
    picture.Text({100.0, y + kRow - 5.0}, c.name, kFont);
    for (int k = 0; k < columns; ++k) DrawCell(map.outcomes[i][k], {kNames + static_cast<double>(k) * kColumn, y}, &picture);
  }
  DrawLegend(kTop + kRow * rows, &picture);
  picture.Save();
}

}  // namespace nscdd
