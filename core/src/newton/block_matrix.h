// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nscdd {

/// Square matrix of B x B blocks (row-major) by rows; its pattern is symmetric and has the diagonal, its values need not be.
template <int B>
struct BlockMatrix {
  static constexpr int kSize = B * B;

  std::vector<std::int32_t> begin;   ///< of each row, and one behind
  std::vector<std::int32_t> column;  ///< ascending in each row
  std::vector<double> values;        ///< kSize a block

  int rows() const { return static_cast<int>(begin.size()) - 1; }

  /// The diagonal and (i, j), (j, i) of each edge; edges may come twice.
  void SetPattern(int rows, const std::vector<std::pair<std::int32_t, std::int32_t>>& edges) {
    std::vector<std::pair<std::int32_t, std::int32_t>> entries;
    entries.reserve(rows + 2 * edges.size());
    for (std::int32_t i = 0; i < rows; ++i) entries.emplace_back(i, i);
    for (const auto& [i, j] : edges) {
      entries.emplace_back(i, j);
      entries.emplace_back(j, i);
    }
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    begin.assign(rows + 1, 0);
    column.clear();
    for (const auto& [i, j] : entries) {
      ++begin[i + 1];
      column.push_back(j);
    }
    for (int i = 0; i < rows; ++i) begin[i + 1] += begin[i];
    values.assign(kSize * column.size(), 0.0);
  }

  /// Number of the block (i, j), which is in the pattern.
  std::int32_t Place(std::int32_t i, std::int32_t j) const {
    const auto first = column.begin() + begin[i];
    return static_cast<std::int32_t>(std::lower_bound(first, column.begin() + begin[i + 1], j) - column.begin());
  }
  double* Block(std::int32_t place) { return &values[kSize * static_cast<std::size_t>(place)]; }
  const double* Block(std::int32_t place) const { return &values[kSize * static_cast<std::size_t>(place)]; }
};

}  // namespace nscdd
