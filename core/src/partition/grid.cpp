// SPDX-License-Identifier: Apache-2.0
#include "partition/grid.h"

#include <algorithm>
#include <cmath>

namespace nscdd {

Grid::Grid(Vec2 low, Vec2 high, int nx, int ny) : low_(low), high_(high), nx_(nx), ny_(ny) {
  width_ = (high.x - low.x) / nx;
  height_ = (high.y - low.y) / ny;
}

void Grid::SetPeriod(double origin, double period) {
  period_ = period;
  low_.x = origin;
  high_.x = origin + period;
  width_ = period / nx_;
}

double Grid::Wrap(double x) const {
  if (period_ == 0.0) return x;
  const double wrapped = x - period_ * std::floor((x - low_.x) / period_);
  // Rounding may land on the open end.
  return wrapped < high_.x ? std::max(wrapped, low_.x) : low_.x;
}

int Grid::Index(double x, double low, double width, int count) {
  if (!(width > 0.0)) return 0;
  // Compare before the conversion: far points do not fit into an int, and of a box as wide as numbers go cells are no number.
  const double cell = std::floor((x - low) / width);
  return cell > 0.0 ? static_cast<int>(std::min(cell, count - 1.0)) : 0;
}

int Grid::CellOf(Vec2 point) const {
  if (cells() == 1) return 0;
  return Index(Wrap(point.x), low_.x, width_, nx_) + nx_ * Index(point.y, low_.y, height_, ny_);
}

}  // namespace nscdd
