// SPDX-License-Identifier: Apache-2.0
#include "cell_grid.h"

#include <limits>
#include <utility>

namespace nscdd::reference {
namespace {

/// Smallest k >= 2 with 2^k >= count.
int LogAtLeast(double count) {
  int log = 2;
  while (log < 40 && static_cast<double>(std::int64_t{1} << log) < count) ++log;
  return log;
}

}  // namespace

void CellGrid::ChooseSize(double width, double height) {
  int log_nx = LogAtLeast(width * inverse_cell_ + 1.0), log_ny = LogAtLeast(height * inverse_cell_ + 1.0);
  const double most = 4.0 * static_cast<double>(entries_->size()) + 16.0;
  while (std::ldexp(1.0, log_nx + log_ny) > most && std::max(log_nx, log_ny) > 2) --(log_nx >= log_ny ? log_nx : log_ny);
  log_nx_ = log_nx;
  mask_x_ = (std::int64_t{1} << log_nx) - 1;
  mask_y_ = (std::int64_t{1} << log_ny) - 1;
  first_.assign((std::size_t{1} << (log_nx + log_ny)) + 1, 0);
}

void CellGrid::Build(std::vector<GridEntry>* entries, double cell) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  entries_ = entries;
  inverse_cell_ = 1.0 / (1.001 * cell);  // rounding of the cell numbers must not part neighbours
  double x1 = -kInfinity, y1 = -kInfinity;
  x0_ = y0_ = kInfinity;
  for (const GridEntry& entry : *entries) {
    x0_ = std::min(x0_, entry.x);
    y0_ = std::min(y0_, entry.y);
    x1 = std::max(x1, entry.x);
    y1 = std::max(y1, entry.y);
  }
  ChooseSize(x1 - x0_, y1 - y0_);
  // Stable counting sort by bucket.
  bucket_of_.resize(entries->size());
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const std::size_t bucket = Bucket(CellX((*entries)[i].x), CellY((*entries)[i].y));
    bucket_of_[i] = static_cast<std::int32_t>(bucket);
    ++first_[bucket];
  }
  std::int32_t sum = 0;
  for (std::int32_t& first : first_) sum += std::exchange(first, sum);
  scratch_.resize(entries->size());
  for (std::size_t i = 0; i < entries->size(); ++i) {
    scratch_[static_cast<std::size_t>(first_[static_cast<std::size_t>(bucket_of_[i])]++)] = (*entries)[i];
  }
  // first_ now holds the ends of the buckets.
  first_.insert(first_.begin(), 0);
  first_.pop_back();
  entries->swap(scratch_);
}

}  // namespace nscdd::reference
