// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nscdd/vector.h"

namespace nscdd {

/// Box of the mobile bodies' centres, cut into nx x ny equal cells; cell (ix, iy) is subdomain ix + nx iy. A point on a cut is
/// in the upper cell; points outside the box are in the nearest cell, so the cells at the border reach to infinity. With a
/// period, x is wrapped into [origin, origin + period), which the cells then cover.
class Grid {
 public:
  Grid() = default;
  Grid(Vec2 low, Vec2 high, int nx, int ny);

  /// The x cuts become those of the period.
  void SetPeriod(double origin, double period);
  /// 0: none, whatever the origin.
  bool HasPeriod(double origin, double period) const { return period_ == period && (period == 0.0 || low_.x == origin); }

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int cells() const { return nx_ * ny_; }
  Vec2 low() const { return low_; }
  Vec2 high() const { return high_; }
  double period() const { return period_; }  ///< [m] 0: none

  int CellOf(Vec2 point) const;

  /// Calls f(cell) for every cell within `reach` of the point (a square of half-width `reach`), none twice, ascending by rows.
  template <class Function>
  void ForEachCellNear(Vec2 point, double reach, Function&& f) const {
    const int y0 = Index(point.y - reach, low_.y, height_, ny_), y1 = Index(point.y + reach, low_.y, height_, ny_);
    // Across the ends of a period the cells go on from the other side; a reach of nearly the period meets all.
    int x0 = 0, x1 = nx_ - 1;
    if (period_ == 0.0) {
      x0 = Index(point.x - reach, low_.x, width_, nx_);
      x1 = Index(point.x + reach, low_.x, width_, nx_);
    } else if (2.0 * reach < period_ - width_) {
      x0 = Index(Wrap(point.x - reach), low_.x, width_, nx_);
      x1 = Index(Wrap(point.x + reach), low_.x, width_, nx_);
      if (x1 < x0) x1 += nx_;
    }
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) f(x % nx_ + nx_ * y);
    }
  }

  /// x moved by whole periods into [origin, origin + period); unchanged without a period.
  double Wrap(double x) const;
  Pose Wrapped(const Pose& q) const { return {Wrap(q.x), q.y, q.angle}; }

 private:
  static int Index(double x, double low, double width, int count);

  Vec2 low_, high_;
  double width_ = 1.0, height_ = 1.0;  // of a cell
  int nx_ = 1, ny_ = 1;
  double period_ = 0.0;
};

/// Ranks hold ascending blocks of subdomains, as even as possible.
class Blocks {
 public:
  Blocks() = default;
  Blocks(int subdomains, int ranks) : subdomains_(subdomains), ranks_(ranks) {}
  int subdomains() const { return subdomains_; }
  int First(int rank) const { return static_cast<int>(static_cast<std::int64_t>(rank) * subdomains_ / ranks_); }
  int Count(int rank) const { return First(rank + 1) - First(rank); }
  int RankOf(int subdomain) const {
    return static_cast<int>((static_cast<std::int64_t>(subdomain + 1) * ranks_ - 1) / subdomains_);
  }

 private:
  int subdomains_ = 1, ranks_ = 1;
};

}  // namespace nscdd
