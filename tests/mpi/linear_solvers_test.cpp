// SPDX-License-Identifier: Apache-2.0
// Eigen and MUMPS solve the same augmented interface, MUMPS on one rank (MPI_COMM_SELF) and over all of them; factorisations
// are kept while pattern and numbers stay. General matrices too.

#include <algorithm>
#include <cmath>
#include <vector>

#include "linear/kept_solver.h"
#include "mpi_test.h"

namespace nscdd {
namespace {

/// Lower triangle of M + lambda G G^T on a ring of n bodies with 2 dofs, the contacts in random directions.
struct Matrix {
  int n = 0;
  std::vector<std::int32_t> row, column;
  std::vector<double> values;
};

Matrix RingMatrix(int bodies, double lambda, int part, int parts) {
  Matrix m;
  m.n = 2 * bodies;
  const auto add = [&](int i, int j, double value) {
    m.row.push_back(std::max(i, j));
    m.column.push_back(std::min(i, j));
    m.values.push_back(value);
  };
  for (int b = part; b < bodies; b += parts) {
    for (const int neighbour : {1, 7}) {
      const int other = (b + neighbour) % bodies;
      const double g[4] = {std::cos(b + neighbour), std::sin(b + neighbour), -std::cos(b + neighbour),
                           -std::sin(b + neighbour)};
      const int at[4] = {2 * b, 2 * b + 1, 2 * other, 2 * other + 1};
      for (int p = 0; p < 4; ++p) {
        for (int q = 0; q <= p; ++q) add(at[p], at[q], lambda * g[p] * g[q]);
      }
    }
    add(2 * b, 2 * b, 1.0 + 0.1 * (b % 5));
    add(2 * b + 1, 2 * b + 1, 1.0 + 0.1 * (b % 5));
  }
  return m;
}

std::vector<double> Solve(KeptSolver* solver, const Matrix& m) {
  std::vector<double> x(m.n);
  for (int i = 0; i < m.n; ++i) x[i] = std::sin(1.0 + i);
  solver->Set(m.n, m.row, m.column, m.values);
  solver->Solve(x);
  return x;
}

double Difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    norm = std::max(norm, std::abs(a[i]));
  }
  return difference / norm;
}

/// The ring's matrix as a general one: both triangles, the upper one scaled, so that it is not symmetric.
Matrix GeneralMatrix() {
  Matrix m = RingMatrix(300, 10.0, 0, 1);
  const std::size_t count = m.row.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (m.row[k] == m.column[k]) continue;
    m.row.push_back(m.column[k]);
    m.column.push_back(m.row[k]);
    m.values.push_back(0.7 * m.values[k]);
  }
  return m;
}

using LinearSolvers = test::MpiTest;

// What solver newton uses for its cross-check.
TEST_F(LinearSolvers, OfGeneralMatricesAgree) {
  const Matrix m = GeneralMatrix();
  KeptSolver eigen(MakeLocalSolver(LinearLibrary::kEigen, Symmetry::kGeneral), &communicator);
  KeptSolver mumps(MakeLocalSolver(LinearLibrary::kMumps, Symmetry::kGeneral), &communicator);
  KeptSolver definite(MakeLocalSolver(LinearLibrary::kEigen), &communicator);
  const std::vector<double> expected = Solve(&eigen, m);
  EXPECT_LT(Difference(expected, Solve(&mumps, m)), 1e-10);
  EXPECT_GT(Difference(expected, Solve(&definite, RingMatrix(300, 10.0, 0, 1))), 1e-3) << "the matrix is symmetric";
}

TEST_F(LinearSolvers, OfTheInterfaceAgreeAndKeepTheirFactors) {
  const int rank = communicator.rank(), ranks = communicator.size();
  KeptSolver eigen(MakeLocalSolver(LinearLibrary::kEigen), &communicator);
  KeptSolver mumps(MakeLocalSolver(LinearLibrary::kMumps), &communicator);
  KeptSolver shared(MakeSharedSolver(LinearLibrary::kMumps, &communicator), &communicator);
  for (const double lambda : {0.1, 10.0, 1e4, 1e6}) {
    const Matrix whole = RingMatrix(300, lambda, 0, 1), mine = RingMatrix(300, lambda, rank, ranks);
    const std::vector<double> expected = Solve(&eigen, whole);
    EXPECT_LT(Difference(expected, Solve(&mumps, whole)), 1e-10) << "lambda = " << lambda;
    EXPECT_LT(Difference(expected, Solve(&shared, shared.is_distributed() ? mine : whole)), 1e-9) << "lambda = " << lambda;
  }
  // The pattern was the same all along, the numbers of the last two solves too.
  for (KeptSolver* solver : {&eigen, &mumps, &shared}) {
    const Matrix again = RingMatrix(300, 1e6, solver->is_distributed() ? rank : 0, solver->is_distributed() ? ranks : 1);
    Solve(solver, again);
    EXPECT_EQ(solver->counters().analyses, 1);
    EXPECT_EQ(solver->counters().factorisations, 4);
  }
}

}  // namespace
}  // namespace nscdd
