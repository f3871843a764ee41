// SPDX-License-Identifier: Apache-2.0
#include "results/results_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "nscdd/vector.h"

namespace nscdd {
namespace {

struct Shape {
  std::int64_t body;
  ShapeKind kind;
  Vec2 from, to;
  double radius;
};

std::vector<Shape> RowsOf(const ShapeTable& table) {
  std::vector<Shape> rows;
  rows.reserve(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    rows.push_back({table.body[i], table.kind[i], {table.x0[i], table.y0[i]}, {table.x1[i], table.y1[i]}, table.radius[i]});
  }
  return rows;
}

/// Finds bodies by id.
class BodyIndex {
 public:
  explicit BodyIndex(const GrainTable& grains) {
    for (std::size_t row = 0; row < grains.size(); ++row) rows_.emplace_back(grains.id[row], row);
    std::sort(rows_.begin(), rows_.end());
  }
  /// Null if the body is not there.
  const std::size_t* Find(std::int64_t id) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), std::pair(id, std::size_t{0}));
    return found != rows_.end() && found->first == id ? &found->second : nullptr;
  }

 private:
  std::vector<std::pair<std::int64_t, std::size_t>> rows_;
};

/// Number of the new point.
std::int32_t AddPoint(Vec2 point, LineTable* lines) {
  lines->x.push_back(point.x);
  lines->y.push_back(point.y);
  return static_cast<std::int32_t>(lines->x.size()) - 1;
}

void AddLine(std::int64_t body, std::int32_t from, std::int32_t to, LineTable* lines) {
  lines->ends.insert(lines->ends.end(), {from, to});
  lines->body.push_back(body);
}

void AddLine(std::int64_t body, Vec2 from, Vec2 to, LineTable* lines) {
  const std::int32_t first = AddPoint(from, lines);
  AddLine(body, first, AddPoint(to, lines), lines);
}

class Placement {
 public:
  Placement(const GrainTable& grains, double mean_radius)
      : grains_(grains), index_(grains), has_shapes_(grains.size(), false), mean_radius_(mean_radius) {}

  void Place(const Shape& shape) {
    const std::size_t* row = index_.Find(shape.body);
    if (row == nullptr) return;
    has_shapes_[*row] = true;
    if (shape.kind == ShapeKind::kDisk) return PlaceDisk(*row, shape.from, shape.radius);
    const Vec2 from = ToWorld(*row, shape.from), to = ToWorld(*row, shape.to);
    if (shape.kind == ShapeKind::kHalfPlane) {
      borders_.push_back({shape.body, shape.kind, from, to, 0.0});
      return;
    }
    Include(from, 0.0);
    Include(to, 0.0);
    AddLine(shape.body, from, to, &placed_.walls);
  }

  PlacedShapes Finish(const RankGroup& ranks) {
    for (std::size_t row = 0; row < grains_.size(); ++row) {
      if (!has_shapes_[row] && grains_.radius[row] > 0.0) PlaceDisk(row, {}, grains_.radius[row]);
    }
    for (double& side : box_) side = ranks.MinOfReals(side);
    for (const Shape& border : borders_) PlaceBorder(border);
    return std::move(placed_);
  }

 private:
  Vec2 ToWorld(std::size_t row, Vec2 local) const {
    return Vec2{grains_.x[row], grains_.y[row]} + Rotate(grains_.angle[row], local);
  }

  void Include(Vec2 point, double around) {
    const std::array sides = {point.x - around, point.y - around, -point.x - around, -point.y - around};
    for (std::size_t k = 0; k < 4; ++k) box_[k] = std::min(box_[k], sides[k]);
  }

  void PlaceDisk(std::size_t row, Vec2 local, double radius) {
    const Vec2 centre = ToWorld(row, local), arm = centre - Vec2{grains_.x[row], grains_.y[row]};
    GrainTable& disks = placed_.disks;
    disks.id.push_back(grains_.id[row]);
    disks.x.push_back(centre.x);
    disks.y.push_back(centre.y);
    disks.angle.push_back(grains_.angle[row]);
    disks.vx.push_back(grains_.vx[row] - grains_.spin[row] * arm.y);
    disks.vy.push_back(grains_.vy[row] + grains_.spin[row] * arm.x);
    disks.spin.push_back(grains_.spin[row]);
    disks.radius.push_back(radius);
    disks.multiplicity.push_back(grains_.multiplicity[row]);
    disks.subdomain.push_back(grains_.subdomain[row]);
    disks.kind.push_back(grains_.kind[row]);
    Include(centre, radius);
    if (grains_.kind[row] != 0) PlaceOutline(grains_.id[row], centre, radius);
  }

  /// A regular polygon whose sides grow with the square root of the radius.
  void PlaceOutline(std::int64_t body, Vec2 centre, double radius) {
    const double ratio = mean_radius_ > 0.0 ? radius / mean_radius_ : 1.0;
    const int sides = std::clamp(static_cast<int>(16.0 * std::sqrt(std::min(ratio, 100.0))), 16, 160);
    const auto first = static_cast<std::int32_t>(placed_.walls.x.size());
    for (int k = 0; k < sides; ++k) {
      AddPoint(centre + Rotate(2.0 * std::numbers::pi * k / sides, {radius, 0.0}), &placed_.walls);
      AddLine(body, first + k, first + (k + 1) % sides, &placed_.walls);
    }
  }

  /// The border of a half-plane, as long as the box is wide across, around the point nearest to its middle.
  void PlaceBorder(const Shape& border) {
    const bool empty = box_[0] == kInfinity;
    const Vec2 low = empty ? border.from : Vec2{box_[0], box_[1]}, high = empty ? border.from : Vec2{-box_[2], -box_[3]};
    const Vec2 along = (1.0 / Norm(border.to - border.from)) * (border.to - border.from);
    const Vec2 foot = border.from + Dot(0.5 * (low + high) - border.from, along) * along;
    const double half = empty ? 1.0 : 0.5 * Norm(high - low);
    AddLine(border.body, foot - half * along, foot + half * along, &placed_.walls);
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  const GrainTable& grains_;
  BodyIndex index_;
  std::vector<bool> has_shapes_;
  double mean_radius_;
  std::vector<Shape> borders_;                                                // of half-planes, in global axes
  std::array<double, 4> box_ = {kInfinity, kInfinity, kInfinity, kInfinity};  // [m] left, bottom, -right, -top
  PlacedShapes placed_;
};

}  // namespace

PlacedShapes PlaceShapes(const GrainTable& grains, const ShapeTable& shapes, double mean_radius, const RankGroup& ranks) {
  Placement placement(grains, mean_radius);
  const std::vector<Shape> mine = RowsOf(shapes);
  ranks.ShowToAll(std::as_bytes(std::span(mine)), [&](std::span<const std::byte> bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(Shape)) {
      Shape shape;
      std::memcpy(&shape, bytes.data() + at, sizeof shape);
      placement.Place(shape);
    }
  });
  return placement.Finish(ranks);
}

LineTable ChainsOf(const ContactRows& contacts) {
  LineTable chains;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vec2 point{contacts.point_x[i], contacts.point_y[i]}, normal{contacts.normal_x[i], contacts.normal_y[i]};
    AddLine(contacts.body_a[i], point - contacts.lever_a[i] * normal, point + contacts.lever_b[i] * normal, &chains);
  }
  return chains;
}

}  // namespace nscdd
