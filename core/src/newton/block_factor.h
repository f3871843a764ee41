// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "newton/block_matrix.h"
#include "nscdd/options.h"

namespace nscdd {

/// Factorisation of block matrices with one pattern.
template <int B>
class BlockFactor {
 public:
  virtual ~BlockFactor() = default;

  virtual void Analyse(const BlockMatrix<B>& matrix) = 0;
  /// With the pattern of Analyse(). False: a pivot vanished or is not finite.
  virtual bool Factorise(const BlockMatrix<B>& matrix) = 0;
  /// x := A^-1 x.
  virtual void Solve(double* x) = 0;
};

/// kAuto: BlockLu, our own. kEigen, kMumps: general sparse LU with pivoting of those libraries, several times slower at a few
/// thousand unknowns; for cross-checks.
template <int B>
std::unique_ptr<BlockFactor<B>> MakeBlockFactor(LinearLibrary library);

}  // namespace nscdd
