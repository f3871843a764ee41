// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "nscdd/error.h"
#include "render/paint.h"

namespace nscdd {
namespace {

constexpr std::array<std::pair<std::string_view, Show>, 4> kShows = {
    {{"grains", Show::kGrains}, {"forces", Show::kForces}, {"multiplicity", Show::kMultiplicity}, {"overlap", Show::kOverlap}}};

/// Part of the largest overlap from which on the paper's figures 8 and 10 mark a contact.
constexpr double kMarkedOverlap = 0.9;

/// What is around the world, depending on what the picture shows.
struct Frame {
  std::string title;
  std::string maximum;  ///< the largest value, in words
  std::vector<LegendEntry> legend;
};

double LargestSpeed(const Drawing& drawing) {
  double largest = 0.0;
  for (std::size_t i = 0; i < drawing.grains.size(); ++i) {
    if (drawing.IsFree(i)) largest = std::max(largest, drawing.Speed(i));
  }
  return largest;
}

Frame PaintGrains(const Drawing& drawing, const Layout& layout, Picture* picture) {
  const double largest = LargestSpeed(drawing);
  const auto colour = [&](std::size_t i) { return largest > 0.0 ? SpeedColour(drawing.Speed(i) / largest) : kPale; };
  PaintDisks(drawing, layout, colour, picture);
  PaintTicks(drawing, layout, picture);
  return {"grains", fmt::format("largest speed {:.3g} m/s", largest), {}};
}

/// Impulse of the thickest lines: few contacts carry several times what the others do, and would leave them invisible.
constexpr double kFullWidthQuantile = 0.995;

Frame PaintForceChains(const Drawing& drawing, const Layout& layout, Picture* picture) {
  std::vector<double> impulses;
  for (const PlacedContact& contact : drawing.contacts) {
    if (contact.impulse > 0.0) impulses.push_back(contact.impulse);
  }
  PaintDisks(
      drawing, layout, [](std::size_t) { return kPale; }, picture);
  if (impulses.empty()) return {"force chains", "no active contact", {}};

  std::sort(impulses.begin(), impulses.end());
  const double largest = impulses.back();
  const double full = impulses[static_cast<std::size_t>(kFullWidthQuantile * static_cast<double>(impulses.size()))];
  PaintForces(drawing, layout, full, picture);
  const double width = LargestChainWidth(drawing, layout);
  Frame frame{
      "force chains", fmt::format("{} active contacts, largest normal impulse {:.3g} N s", impulses.size(), largest), {}};
  for (const double part : {0.2, 0.5, 1.0}) {
    const char* or_more = part == 1.0 && full < largest ? "\u2265 " : "";
    frame.legend.push_back({kChain, part * width, fmt::format("{}{:.2g} N s", or_more, part * full)});
  }
  return frame;
}

/// Legend of the multiplicities that occur, with the number of free bodies of each.
std::vector<LegendEntry> MultiplicityLegend(const Drawing& drawing) {
  std::array<int, kLargestMultiplicityColour + 1> counts = {};
  for (std::size_t i = 0; i < drawing.grains.size(); ++i) {
    const auto colour = std::clamp(drawing.grains.multiplicity[i], 0, kLargestMultiplicityColour);
    if (drawing.IsFree(i)) ++counts[static_cast<std::size_t>(colour)];
  }
  std::vector<LegendEntry> legend;
  for (std::int32_t m = 0; m <= kLargestMultiplicityColour; ++m) {
    const int count = counts[static_cast<std::size_t>(m)];
    const char* relation = m == kLargestMultiplicityColour ? "\u2265" : "=";
    if (count > 0) legend.push_back({MultiplicityColour(m), 0.0, fmt::format("m {} {}: {}", relation, m, count)});
  }
  return legend;
}

Frame PaintMultiplicity(const Drawing& drawing, const Layout& layout, Picture* picture) {
  std::int32_t largest = 0;
  std::int64_t on_interface = 0;
  for (std::size_t i = 0; i < drawing.grains.size(); ++i) {
    if (!drawing.IsFree(i)) continue;
    largest = std::max(largest, drawing.grains.multiplicity[i]);
    if (drawing.grains.multiplicity[i] > 1) ++on_interface;
  }
  PaintDisks(
      drawing, layout, [&](std::size_t i) { return MultiplicityColour(drawing.grains.multiplicity[i]); }, picture);
  return {fmt::format("multiplicity, {}x{} subdomains", drawing.run.subdomains_x, drawing.run.subdomains_y),
          fmt::format("{} interface grains, largest multiplicity {}", on_interface, largest), MultiplicityLegend(drawing)};
}

Frame PaintLargestOverlaps(const Drawing& drawing, const Layout& layout, Picture* picture) {
  double largest = 0.0;
  for (const PlacedContact& contact : drawing.contacts) largest = std::max(largest, contact.overlap);
  PaintDisks(
      drawing, layout, [&](std::size_t i) { return MultiplicityColour(std::min(drawing.grains.multiplicity[i], 2)); }, picture);
  Frame frame{
      "overlap", "no overlap", {{MultiplicityColour(1), 0.0, "one subdomain"}, {MultiplicityColour(2), 0.0, "several"}}};
  if (largest == 0.0) return frame;
  PaintOverlaps(drawing, layout, kMarkedOverlap * largest, picture);
  frame.maximum = fmt::format("largest overlap {:.3g} m = {:.3g} mean radii", largest, largest / drawing.step.mean_radius);
  frame.legend.push_back({kOverlapRed, 0.35 * layout.font, "overlap \u2265 0.9 of the largest"});
  return frame;
}

Frame PaintWorld(const Drawing& drawing, const Layout& layout, Show show, Picture* picture) {
  PaintHalfPlanes(drawing, layout, picture);
  Frame frame;
  switch (show) {
    case Show::kGrains:
      frame = PaintGrains(drawing, layout, picture);
      break;
    case Show::kForces:
      frame = PaintForceChains(drawing, layout, picture);
      break;
    case Show::kMultiplicity:
      frame = PaintMultiplicity(drawing, layout, picture);
      break;
    case Show::kOverlap:
      frame = PaintLargestOverlaps(drawing, layout, picture);
      break;
  }
  PaintLines(drawing, layout, picture);
  return frame;
}

void PaintAll(const Drawing& drawing, const Layout& layout, Show show, Picture* picture) {
  cairo_t* context = picture->context();
  cairo_save(context);
  cairo_rectangle(context, layout.corner.x, layout.corner.y, layout.world_width, layout.world_height);
  cairo_clip(context);
  const Frame frame = PaintWorld(drawing, layout, show, picture);
  cairo_restore(context);

  const auto free = std::count(drawing.grains.kind.begin(), drawing.grains.kind.end(), 0);
  PaintTitle(layout, fmt::format("{}: {}", drawing.run.scene, frame.title),
             fmt::format("step {}, t = {:.4g} s \u00b7 {} grains \u00b7 {}", drawing.step.step, drawing.step.time, free,
                         frame.maximum),
             picture);
  PaintScaleBar(layout, picture);
  if (show == Show::kGrains) {
    const double largest = LargestSpeed(drawing);
    if (largest > 0.0) PaintSpeedBar(layout, largest, picture);
  } else {
    PaintLegend(layout, frame.legend, picture);
  }
}

}  // namespace

Show ParseShow(std::string_view word) {
  const auto found = std::find_if(kShows.begin(), kShows.end(), [&](const auto& entry) { return entry.first == word; });
  if (found != kShows.end()) return found->second;
  throw Error(fmt::format("cannot show '{}': choose one of grains, forces, multiplicity, overlap.", word));
}

std::string_view ShowName(Show show) {
  return std::find_if(kShows.begin(), kShows.end(), [&](const auto& entry) { return entry.second == show; })->first;
}

RenderedPicture Render(const RenderRequest& request) {
  if (!request.output.empty()) IsSvg(request.output);  // refuse before the work
  const Drawing drawing = ReadDrawing(request.folder, request.step);
  const Layout layout = MakeLayout(drawing);
  const std::filesystem::path file =
      request.output.empty() ? request.folder / fmt::format("{}_{:06}.png", ShowName(request.show), drawing.step.step)
                             : request.output;
  Picture picture(file, layout.width, layout.height);
  PaintAll(drawing, layout, request.show, &picture);
  picture.Save();
  return {file, drawing.step.step, layout.width, layout.height};
}

}  // namespace nscdd
