// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "linear/kept_solver.h"
#include "newton/block_factor.h"

namespace nscdd {

/// The same by a library's general sparse LU.
template <int B>
class LibraryLu final : public BlockFactor<B> {
 public:
  /// `solver`: of this process alone.
  explicit LibraryLu(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver), nullptr) {}

  void Analyse(const BlockMatrix<B>& matrix) override;
  bool Factorise(const BlockMatrix<B>& matrix) override;
  void Solve(double* x) override;

 private:
  KeptSolver solver_;
  std::size_t size_ = 0;
  std::vector<std::int32_t> row_, column_;
};

}  // namespace nscdd
