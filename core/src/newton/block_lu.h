// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "newton/block_factor.h"

namespace nscdd {

/// LU in blocks of B x B without pivoting, rows in approximate minimum degree order. The graph of contacts of disks is planar:
/// its fill is small, and the blocks are dense, which a scalar sparse LU does not know. Whoever uses it checks the residual
/// (one step of refinement).
template <int B>
class BlockLu final : public BlockFactor<B> {
 public:
  void Analyse(const BlockMatrix<B>& matrix) override;
  bool Factorise(const BlockMatrix<B>& matrix) override;
  void Solve(double* x) override;

 private:
  /// Blocks of a triangle by rows, columns ascending, in the order of elimination.
  struct Triangle {
    std::vector<std::int32_t> begin, column;
    std::vector<double> values;
  };
  void Scatter(const BlockMatrix<B>& matrix);
  bool EliminateRow(int i);

  std::vector<std::int32_t> row_of_, place_of_row_;  // order of elimination -> row, and back
  Triangle lower_, upper_;
  std::vector<double> diagonal_;       // inverted after Factorise()
  std::vector<double*> block_in_row_;  // of the row in elimination, by column
  std::vector<double> scratch_;
};

}  // namespace nscdd
