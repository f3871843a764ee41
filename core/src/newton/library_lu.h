// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "linear/linear_solver.h"
#include "newton/block_factor.h"

namespace nscdd {

/// The same by a library's general sparse LU.
template <int B>
class LibraryLu final : public BlockFactor<B> {
 public:
  explicit LibraryLu(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}

  void Analyse(const BlockMatrix<B>& matrix) override;
  bool Factorise(const BlockMatrix<B>& matrix) override;
  void Solve(double* x) override;

 private:
  std::unique_ptr<LinearSolver> solver_;
  std::size_t size_ = 0;
};

}  // namespace nscdd
