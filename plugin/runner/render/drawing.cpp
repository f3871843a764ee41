// SPDX-License-Identifier: Apache-2.0
#include "render/drawing.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "nscdd/error.h"
#include "results/results_reader.h"

namespace nscdd {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Row of the grain of this id.
std::size_t RowOf(const GrainTable& grains, std::int64_t id) {
  const auto found = std::lower_bound(grains.id.begin(), grains.id.end(), id);
  return found != grains.id.end() && *found == id ? static_cast<std::size_t>(found - grains.id.begin()) : kNone;
}

Vec2 CentreOf(const GrainTable& grains, std::size_t row) { return {grains.x[row], grains.y[row]}; }

Vec2 ToWorld(const GrainTable& grains, std::size_t row, Vec2 local) {
  return CentreOf(grains, row) + Rotate(grains.angle[row], local);
}

void PlaceShapes(const ShapeTable& shapes, Drawing* drawing) {
  const GrainTable& grains = drawing->grains;
  std::vector<bool> has_shapes(grains.size(), false);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::size_t row = RowOf(grains, shapes.body[i]);
    if (row == kNone) continue;  // the body left the world
    has_shapes[row] = true;
    const Vec2 from = ToWorld(grains, row, {shapes.x0[i], shapes.y0[i]});
    if (shapes.kind[i] == ShapeKind::kDisk) {
      drawing->disks.push_back({row, from, shapes.radius[i]});
    } else {
      const Vec2 to = ToWorld(grains, row, {shapes.x1[i], shapes.y1[i]});
      drawing->lines.push_back({row, from, to, shapes.kind[i] == ShapeKind::kHalfPlane});
    }
  }
  for (std::size_t row = 0; row < grains.size(); ++row) {
    if (!has_shapes[row] && grains.radius[row] > 0.0) {
      drawing->disks.push_back({row, CentreOf(grains, row), grains.radius[row]});
    }
  }
  std::stable_sort(drawing->disks.begin(), drawing->disks.end(),
                   [](const PlacedDisk& a, const PlacedDisk& b) { return a.grain < b.grain; });
}

/// The disk of this body whose surface is nearest to the point; null if the body has no disk or is unknown.
const PlacedDisk* DiskAt(const Drawing& drawing, std::int64_t body, Vec2 point) {
  const std::size_t row = RowOf(drawing.grains, body);
  const auto [begin, end] = std::equal_range(drawing.disks.begin(), drawing.disks.end(), PlacedDisk{row, {}, 0.0},
                                             [](const PlacedDisk& a, const PlacedDisk& b) { return a.grain < b.grain; });
  const auto distance = [&](const PlacedDisk& disk) { return std::abs(Norm(point - disk.centre) - disk.radius); };
  const auto nearest =
      std::min_element(begin, end, [&](const PlacedDisk& a, const PlacedDisk& b) { return distance(a) < distance(b); });
  return nearest == end ? nullptr : &*nearest;
}

/// `point` seen in the period in which `reference` is; a body may have been carried over since the contact was found.
Vec2 Nearest(Vec2 point, Vec2 reference, double period) {
  if (period > 0.0) point.x += period * std::round((reference.x - point.x) / period);
  return point;
}

void PlaceContacts(const ContactRows& contacts, Drawing* drawing) {
  const double period = drawing->run.period;
  drawing->contacts.reserve(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vec2 point{contacts.point_x[i], contacts.point_y[i]};
    // The image of B that touches A is the one near the point; A's own is taken near it as well.
    const auto end_of = [&](std::int64_t body) {
      const std::size_t row = RowOf(drawing->grains, body);
      if (row == kNone) return point;
      const Vec2 shift = CentreOf(drawing->grains, row) - Nearest(CentreOf(drawing->grains, row), point, period);
      const PlacedDisk* disk = DiskAt(*drawing, body, point + shift);
      return disk == nullptr ? point : disk->centre - shift;
    };
    drawing->contacts.push_back(
        {end_of(contacts.body_a[i]), end_of(contacts.body_b[i]), contacts.impulse_n[i], std::max(0.0, -contacts.final_gap[i])});
  }
}

/// Limits `box` to `inner` and a margin around it.
Box Clamp(const Box& box, const Box& inner, double margin) {
  return {{std::max(box.low.x, inner.low.x - margin), std::max(box.low.y, inner.low.y - margin)},
          {std::min(box.high.x, inner.high.x + margin), std::min(box.high.y, inner.high.y + margin)}};
}

/// Free bodies, walls near them, and a margin; one period where there is one.
Box BoxOf(const Drawing& drawing) {
  Box free, all;
  for (const PlacedDisk& disk : drawing.disks) {
    if (drawing.IsFree(disk.grain)) free.Include(disk.centre, disk.radius);
    all.Include(disk.centre, disk.radius);
  }
  for (const PlacedLine& line : drawing.lines) {
    if (line.is_half_plane) continue;
    all.Include(line.from, 0.0);
    all.Include(line.to, 0.0);
  }
  if (all.is_empty()) all.Include({0.0, 0.0}, 1.0);
  Box box = all;
  if (!free.is_empty()) box = Clamp(all, free, 0.2 * std::max(free.width(), free.height()) + 2.0 * drawing.step.mean_radius);
  const double margin = 0.02 * std::max(box.width(), box.height()) + 0.3 * drawing.step.mean_radius;
  box.low = box.low - Vec2{margin, margin};
  box.high = box.high + Vec2{margin, margin};
  if (drawing.run.period > 0.0) {
    box.low.x = drawing.run.period_origin;
    box.high.x = drawing.run.period_origin + drawing.run.period;
  }
  return box;
}

}  // namespace

void Box::Include(Vec2 point, double around) {
  low = {std::min(low.x, point.x - around), std::min(low.y, point.y - around)};
  high = {std::max(high.x, point.x + around), std::max(high.y, point.y + around)};
}

Drawing ReadDrawing(const std::filesystem::path& folder, std::optional<std::int64_t> step) {
  const ResultsReader reader(folder);
  if (reader.steps().empty()) {
    throw Error(fmt::format("{} holds no step: run the scene with at least one.", (folder / "results.h5").string()));
  }
  const std::int64_t number = step.value_or(reader.steps().back());
  Drawing drawing;
  drawing.run = reader.run();
  drawing.step = reader.ReadStep(number);
  drawing.grains = reader.ReadGrains(number);
  PlaceShapes(reader.ReadShapes(), &drawing);
  PlaceContacts(reader.ReadContacts(number), &drawing);
  drawing.box = BoxOf(drawing);
  return drawing;
}

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
