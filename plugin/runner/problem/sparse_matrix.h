// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace nscdd {

/// A matrix in compressed columns; rows ascend within a column.
struct SparseMatrix {
  explicit SparseMatrix(std::int32_t row_count) : rows(row_count) {}

  std::int32_t columns() const { return static_cast<std::int32_t>(start.size()) - 1; }
  void AppendColumn(const std::map<std::int32_t, double>& entries) {
    for (const auto& [r, x] : entries) {
      row.push_back(r);
      value.push_back(x);
    }
    start.push_back(static_cast<std::int32_t>(row.size()));
  }

  std::int32_t rows;
  std::vector<std::int32_t> start = {0};  ///< of each column in the two below, and their size
  std::vector<std::int32_t> row;
  std::vector<double> value;
};

}  // namespace nscdd
