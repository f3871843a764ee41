#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <vector>

#include "linear/linear_solver.h"

namespace nscdd {

/// A compressed matrix that is filled from triplets again and again.
class TripletMatrix {
 public:
  void SetPattern(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column);
  void SetValues(std::span<const double> values);
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  Eigen::SparseMatrix<double> matrix_;
  std::vector<std::int32_t> place_;  // of each triplet among the values of matrix_
};

/// Eigen's simplicial LDL^T with AMD order.
class EigenSolver final : public LinearSolver {
 public:
  bool is_distributed() const override { return false; }
  void Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) override;
  void Factorise(std::span<const double> values) override;
  void Solve(std::span<double> x) override;

 private:
  TripletMatrix matrix_;  // lower triangle
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
};

/// Eigen's supernodal LU with partial pivoting and COLAMD order, for general matrices.
class EigenLuSolver final : public LinearSolver {
 public:
  bool is_distributed() const override { return false; }
  void Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) override;
  void Factorise(std::span<const double> values) override;
  void Solve(std::span<double> x) override;

 private:
  TripletMatrix matrix_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factor_;
};

}  // namespace nscdd
