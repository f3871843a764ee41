#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "linear/linear_solver.h"

namespace nscdd {

/// Eigen's simplicial LDL^T with AMD order.
class EigenSolver final : public LinearSolver {
 public:
  bool is_distributed() const override { return false; }
  void Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) override;
  void Factorise(std::span<const double> values) override;
  void Solve(std::span<double> x) override;

 private:
  Eigen::SparseMatrix<double> matrix_;  // lower triangle
  std::vector<std::int32_t> place_;     // of each triplet among the values of matrix_
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
};

}  // namespace nscdd
