// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd::reference {

/// A disk as the grid sees it. In a periodic world `x` is wrapped into the period, and disks near its beginning have a second
/// entry, one period further on.
struct GridEntry {
  double x = 0.0;  ///< = the disk's own x + shift * period
  double y = 0.0;
  double radius = 0.0;
  std::int32_t disk = 0;
  std::int32_t shift = 0;
  bool is_copy = false;
};

/// Square cells over the disks of one size class, folded onto a torus of at most about two cells per disk. Disks that fold onto
/// each other only cost a distance test, so a grain that flew far away costs nothing, and nothing is lost. Neighbouring cells
/// never fold onto each other, so no pair is met twice.
class CellGrid {
 public:
  /// Points less than `cell` [m] apart are found. Reorders the entries by cell.
  void Build(std::vector<GridEntry>* entries, double cell);

  std::span<const GridEntry> entries() const { return *entries_; }

  /// Calls visit(entry, entry) once for every two entries in the same cell or in neighbouring ones.
  template <typename Visit>
  void VisitPairs(Visit visit) const;

  /// Calls visit(entry) for every entry in the nine cells around (x, y).
  template <typename Visit>
  void VisitAround(double x, double y, Visit visit) const;

  /// Calls visit(entry) once for every entry within `reach` of the segment from a to b, and for some further away.
  template <typename Visit>
  void VisitBand(Vec2 a, Vec2 b, double reach, Visit visit) const;

 private:
  std::int64_t CellX(double x) const { return Cell(x - x0_); }
  std::int64_t CellY(double y) const { return Cell(y - y0_); }
  /// The border cells take everything beyond them.
  std::int64_t Cell(double distance) const {
    return static_cast<std::int64_t>(std::clamp(distance * inverse_cell_, 0.0, 1e12));
  }
  std::size_t Bucket(std::int64_t cx, std::int64_t cy) const {
    return static_cast<std::size_t>((cy & mask_y_) << log_nx_ | (cx & mask_x_));
  }
  template <typename Visit>
  void VisitBucket(std::size_t bucket, Visit visit) const {
    for (std::int32_t i = first_[bucket]; i < first_[bucket + 1]; ++i) visit((*entries_)[static_cast<std::size_t>(i)]);
  }
  void ChooseSize(double width, double height);

  double x0_ = 0.0;
  double y0_ = 0.0;
  double inverse_cell_ = 1.0;
  std::int64_t mask_x_ = 3;  // numbers of columns and rows are powers of two, at least 4
  std::int64_t mask_y_ = 3;
  int log_nx_ = 2;
  std::vector<GridEntry>* entries_ = nullptr;
  std::vector<std::int32_t> first_;  // of each bucket, and the end
  std::vector<std::int32_t> bucket_of_;
  std::vector<GridEntry> scratch_;
};

template <typename Visit>
void CellGrid::VisitPairs(Visit visit) const {
  const std::vector<GridEntry>& entries = *entries_;
  for (std::int64_t cy = 0; cy <= mask_y_; ++cy) {
    for (std::int64_t cx = 0; cx <= mask_x_; ++cx) {
      const std::size_t bucket = Bucket(cx, cy);
      const std::int32_t begin = first_[bucket], end = first_[bucket + 1];
      if (begin == end) continue;
      const std::size_t forward[4] = {Bucket(cx + 1, cy), Bucket(cx - 1, cy + 1), Bucket(cx, cy + 1), Bucket(cx + 1, cy + 1)};
      for (std::int32_t i = begin; i < end; ++i) {
        const GridEntry& entry = entries[static_cast<std::size_t>(i)];
        for (std::int32_t j = i + 1; j < end; ++j) visit(entry, entries[static_cast<std::size_t>(j)]);
        for (const std::size_t other : forward) VisitBucket(other, [&](const GridEntry& near) { visit(entry, near); });
      }
    }
  }
}

template <typename Visit>
void CellGrid::VisitAround(double x, double y, Visit visit) const {
  const std::int64_t cx = CellX(x), cy = CellY(y);
  for (std::int64_t dy = -1; dy <= 1; ++dy) {
    for (std::int64_t dx = -1; dx <= 1; ++dx) VisitBucket(Bucket(cx + dx, cy + dy), visit);
  }
}

template <typename Visit>
void CellGrid::VisitBand(Vec2 a, Vec2 b, double reach, Visit visit) const {
  const std::int64_t row0 = CellY(std::min(a.y, b.y) - reach), row1 = CellY(std::max(a.y, b.y) + reach);
  const double cell = 1.0 / inverse_cell_;
  const bool every_row = row1 - row0 >= mask_y_;  // then rows fold onto each other: take the segment's whole width in each
  const Vec2 low = a.y <= b.y ? a : b, high = a.y <= b.y ? b : a;
  const auto x_at = [&](double y) {
    const double t = high.y > low.y ? std::clamp((y - low.y) / (high.y - low.y), 0.0, 1.0) : 0.0;
    return low.x + t * (high.x - low.x);
  };
  for (std::int64_t cy = row0; cy <= (every_row ? row0 + mask_y_ : row1); ++cy) {
    double xa = low.x, xb = high.x;
    if (!every_row && high.y > low.y) {
      const double y = y0_ + static_cast<double>(cy) * cell;
      xa = x_at(y - reach - 0.01 * cell);
      xb = x_at(y + 1.01 * cell + reach);
    }
    const std::int64_t column0 = CellX(std::min(xa, xb) - reach), column1 = CellX(std::max(xa, xb) + reach);
    const std::int64_t columns = std::min(column1 - column0, mask_x_);
    for (std::int64_t cx = column0; cx <= column0 + columns; ++cx) VisitBucket(Bucket(cx, cy), visit);
  }
}

}  // namespace nscdd::reference
