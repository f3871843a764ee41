// SPDX-License-Identifier: Apache-2.0
#include "scene/generators.h"

#include <algorithm>
#include <cmath>

namespace nscdd {

std::int64_t LatticeColumns(const Lattice& lattice) {
  const double shift = lattice.hexagonal ? 0.5 * lattice.spacing : 0.0;
  const double room = lattice.right - lattice.left - 2.0 * (lattice.max_radius + lattice.jitter) - shift;
  if (room < 0.0) return 0;
  return static_cast<std::int64_t>(std::min(std::floor(room / lattice.spacing), 1e15)) + 1;
}

reference::Disk LatticeDisk(const Lattice& lattice, std::int64_t index) {
  const std::int64_t columns = LatticeColumns(lattice);
  const std::int64_t row = index / columns;
  const double row_height = lattice.hexagonal ? 0.5 * std::sqrt(3.0) * lattice.spacing : lattice.spacing;
  const double shift = lattice.hexagonal && row % 2 == 1 ? 0.5 * lattice.spacing : 0.0;
  const double margin = lattice.max_radius + lattice.jitter;
  const auto number = [&](std::uint64_t k) { return UniformNumber(lattice.seed, 3 * static_cast<std::uint64_t>(index) + k); };
  reference::Disk disk;
  disk.radius = lattice.min_radius + (lattice.max_radius - lattice.min_radius) * number(0);
  disk.centre.x = lattice.left + margin + shift + lattice.spacing * static_cast<double>(index % columns) +
                  lattice.jitter * (2.0 * number(1) - 1.0);
  disk.centre.y = lattice.bottom + margin + row_height * static_cast<double>(row) + lattice.jitter * (2.0 * number(2) - 1.0);
  return disk;
}

namespace {

/// Upper centre of a disk of `radius` that touches both; nothing if it would not rest between them.
std::optional<Vec2> OnTwoDisks(const reference::Disk& left, const reference::Disk& right, double radius) {
  const Vec2 between = right.centre - left.centre;
  const double distance2 = Dot(between, between);
  const double to_left = left.radius + radius, to_right = right.radius + radius;
  if (distance2 > (to_left + to_right) * (to_left + to_right)) return std::nullopt;
  const double distance = std::sqrt(distance2);
  const double along = (to_left * to_left - to_right * to_right + distance2) / (2.0 * distance);
  const double height2 = to_left * to_left - along * along;
  if (!(height2 >= 0.0)) return std::nullopt;
  const Vec2 u = (1.0 / distance) * between;
  const Vec2 centre = left.centre + along * u + std::sqrt(height2) * Vec2{-u.y, u.x};
  if (centre.x < left.centre.x || centre.x > right.centre.x) return std::nullopt;
  return centre;
}

/// The same on one disk and a side at which the centre's abscissa is `x`.
std::optional<Vec2> OnDiskAndSide(const reference::Disk& disk, double x, double radius) {
  const double reach = disk.radius + radius, dx = disk.centre.x - x;
  if (std::abs(dx) > reach) return std::nullopt;
  return Vec2{x, disk.centre.y + std::sqrt(reach * reach - dx * dx)};
}

}  // namespace

reference::Disk DepositionGenerator::Next() {
  const double width = deposition_.right - deposition_.left;
  const double radius =
      deposition_.min_radius + (deposition_.max_radius - deposition_.min_radius) * UniformNumber(deposition_.seed, 2 * index_);
  const double x = deposition_.left + width * UniformNumber(deposition_.seed, 2 * index_ + 1);
  ++index_;
  if (!floor_is_full_) {
    if (const std::optional<Vec2> centre = OnFloor(radius)) return surface_.emplace_back(reference::Disk{*centre, radius});
    floor_is_full_ = true;
  }
  // Rolls over a few neighbours; the whole surface is searched only where none of them offers a seat.
  const double reach = 6.0 * deposition_.max_radius;
  std::optional<Seat> found = LowestSeat(x - reach, x + reach, radius);
  if (!found) found = LowestSeat(deposition_.left, deposition_.right, radius);
  const Seat seat = found ? *found : OnTop(radius);
  const auto begin = surface_.begin();
  const auto place =
      surface_.erase(begin + static_cast<std::ptrdiff_t>(seat.first), begin + static_cast<std::ptrdiff_t>(seat.last));
  return *surface_.insert(place, reference::Disk{seat.centre, radius});
}

std::optional<Vec2> DepositionGenerator::OnFloor(double radius) const {
  const double y = deposition_.bottom + radius;
  if (surface_.empty()) return Vec2{deposition_.left + radius, y};
  // Both touch the floor: (r1 + r2)^2 = dx^2 + (r1 - r2)^2.
  const double x = surface_.back().centre.x + 2.0 * std::sqrt(surface_.back().radius * radius);
  if (x + radius > deposition_.right) return std::nullopt;
  return Vec2{x, y};
}

/// Seat between the surface disks `left` (-1: the left side) and `right` (size: the right side).
std::optional<Vec2> DepositionGenerator::Between(std::ptrdiff_t left, std::size_t right, double radius) const {
  const double min_x = deposition_.left + radius, max_x = deposition_.right - radius;
  std::optional<Vec2> centre;
  if (left < 0) {
    if (right == surface_.size() || surface_[right].centre.x < min_x) return std::nullopt;
    centre = OnDiskAndSide(surface_[right], min_x, radius);
  } else if (right == surface_.size()) {
    if (surface_[static_cast<std::size_t>(left)].centre.x > max_x) return std::nullopt;
    centre = OnDiskAndSide(surface_[static_cast<std::size_t>(left)], max_x, radius);
  } else {
    centre = OnTwoDisks(surface_[static_cast<std::size_t>(left)], surface_[right], radius);
  }
  if (centre && (centre->x < min_x || centre->x > max_x || centre->y < deposition_.bottom + radius)) return std::nullopt;
  return centre;
}

/// Is the place above the line through the surface's centres? What lies below is forgotten and may be occupied.
bool DepositionGenerator::IsAbove(Vec2 centre) const {
  const std::size_t right = FirstFrom(centre.x);
  if (right == 0) return centre.y > surface_.front().centre.y;
  if (right == surface_.size()) return centre.y > surface_.back().centre.y;
  const Vec2 from = surface_[right - 1].centre;
  return Cross(surface_[right].centre - from, centre - from) > 0.0;
}

bool DepositionGenerator::IsFree(Vec2 centre, double radius) const {
  if (!IsAbove(centre)) return false;
  const double reach = radius + deposition_.max_radius;
  for (std::size_t i = FirstFrom(centre.x - reach); i < surface_.size() && surface_[i].centre.x < centre.x + reach; ++i) {
    const Vec2 d = surface_[i].centre - centre;
    const double touch = (surface_[i].radius + radius) * (1.0 - 1e-12);
    if (Dot(d, d) < touch * touch) return false;
  }
  return true;
}

/// First surface disk at `x` or right of it.
std::size_t DepositionGenerator::FirstFrom(double x) const {
  const auto first = std::lower_bound(surface_.begin(), surface_.end(), x,
                                      [](const reference::Disk& disk, double value) { return disk.centre.x < value; });
  return static_cast<std::size_t>(first - surface_.begin());
}

/// Among the seats whose left support is between `from` and `to`, or the left side if that is within.
std::optional<DepositionGenerator::Seat> DepositionGenerator::LowestSeat(double from, double to, double radius) const {
  std::optional<Seat> best;
  const auto count = static_cast<std::ptrdiff_t>(surface_.size());
  const double widest = 2.0 * (radius + deposition_.max_radius);
  const auto first = from <= deposition_.left ? std::ptrdiff_t{-1} : static_cast<std::ptrdiff_t>(FirstFrom(from));
  const auto position = [&](std::ptrdiff_t i) {
    return i < 0 ? deposition_.left : surface_[static_cast<std::size_t>(i)].centre.x;
  };
  for (std::ptrdiff_t left = first; left < count && position(left) <= to; ++left) {
    // Low disks may lie between the two that carry the new one; it covers them.
    for (std::ptrdiff_t right = left + 1; right <= count; ++right) {
      const auto r = static_cast<std::size_t>(right);
      if (right < count && surface_[r].centre.x - position(left) > widest) break;
      const std::optional<Vec2> centre = Between(left, r, radius);
      if (centre && (!best || centre->y < best->centre.y) && IsFree(*centre, radius)) {
        best = Seat{*centre, static_cast<std::size_t>(left + 1), r};
      }
    }
  }
  return best;
}

/// Above everything: where no stable seat is left (a box hardly wider than the disks).
DepositionGenerator::Seat DepositionGenerator::OnTop(double radius) const {
  const auto top = [](const reference::Disk& disk) { return disk.centre.y + disk.radius; };
  const auto highest = std::max_element(surface_.begin(), surface_.end(),
                                        [&](const reference::Disk& p, const reference::Disk& q) { return top(p) < top(q); });
  const Vec2 centre{std::clamp(highest->centre.x, deposition_.left + radius, deposition_.right - radius),
                    top(*highest) + radius};
  const auto right =
      std::find_if(surface_.begin(), surface_.end(), [&](const reference::Disk& disk) { return disk.centre.x > centre.x; });
  const auto place = static_cast<std::size_t>(right - surface_.begin());
  return {centre, place, place};
}

}  // namespace nscdd
