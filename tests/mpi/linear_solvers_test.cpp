// SPDX-License-Identifier: Apache-2.0
// Eigen and MUMPS solve the same augmented interface, MUMPS on one rank (MPI_COMM_SELF) and over all of them; factorisations
// are kept while pattern and numbers stay. General matrices too.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linear/kept_solver.h"
#include "mpi_test.h"
#include "nscdd/error.h"

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

Matrix Diagonal(int n, int place, double value) {
  Matrix m;
  m.n = n;
  for (int i = 0; i < n; ++i) {
    m.row.push_back(i);
    m.column.push_back(i);
    m.values.push_back(i == place ? value : 2.0);
  }
  return m;
}

/// 550 blocks of 2 x 2 and rank 1, but for rounding; both triangles if `symmetry` asks for them.
Matrix NullDirections(Symmetry symmetry) {
  Matrix m;
  m.n = 1100;
  for (int i = 0; i < m.n; i += 2) {
    const double u = 1.0 + 0.3 * std::sin(i), v = 0.7 + 0.2 * std::cos(i);
    const double block[2][2] = {{u * u, u * v}, {v * u, v * v * (1.0 + 1e-15)}};
    for (int p = 0; p < 2; ++p) {
      for (int q = 0; q < 2; ++q) {
        if (q > p && symmetry == Symmetry::kPositiveDefinite) continue;
        m.row.push_back(i + p);
        m.column.push_back(i + q);
        m.values.push_back(block[p][q]);
      }
    }
  }
  return m;
}

/// Two entries at one place, finite, whose sum is not.
Matrix Overflow() {
  Matrix m = Diagonal(5, 2, 1e308);
  m.row.push_back(2);
  m.column.push_back(2);
  m.values.push_back(1e308);
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

struct Faulty {
  const char* fault;
  Matrix matrix;
};

std::vector<Faulty> FaultyMatrices(Symmetry symmetry) {
  std::vector<Faulty> all{{"a zero pivot", Diagonal(5, 3, 0.0)},
                          {"not a number in the first place", Diagonal(5, 0, NAN)},
                          {"not a number in the middle", Diagonal(5, 2, NAN)},
                          {"infinity", Diagonal(5, 4, INFINITY)},
                          {"null directions", NullDirections(symmetry)}};
  if (symmetry == Symmetry::kPositiveDefinite) {
    all.push_back({"a negative pivot", Diagonal(1000, 700, -1.0)});
    all.push_back({"an overflow", Overflow()});  // which the scaling of MUMPS for general matrices survives
  }
  return all;
}

std::string RefusalOf(KeptSolver* solver, const Matrix& m) {
  try {
    Solve(solver, m);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

// Wherever the fault stands; and the solver is as good as new after it.
TEST_F(LinearSolvers, RefuseWhatTheyCannotSolve) {
  const auto general = Symmetry::kGeneral, definite = Symmetry::kPositiveDefinite;
  const auto expect = [&](const char* name, Symmetry symmetry, auto make) {
    for (const Faulty& subject : FaultyMatrices(symmetry)) {
      SCOPED_TRACE(std::string(name) + ", " + subject.fault);
      KeptSolver solver(make(), &communicator);
      const bool gives = !solver.is_distributed() || communicator.rank() == 0;
      const auto part = [&](const Matrix& m) { return gives ? m : Matrix{m.n, {}, {}, {}}; };
      EXPECT_NE(RefusalOf(&solver, part(subject.matrix)).find("to working precision"), std::string::npos);
      EXPECT_NEAR(Solve(&solver, part(Diagonal(5, -1, 0.0)))[4], 0.5 * std::sin(5.0), 1e-15);
    }
  };
  expect("Eigen", definite, [&] { return MakeLocalSolver(LinearLibrary::kEigen, definite); });
  expect("Eigen, general", general, [&] { return MakeLocalSolver(LinearLibrary::kEigen, general); });
  expect("MUMPS", definite, [&] { return MakeLocalSolver(LinearLibrary::kMumps, definite); });
  expect("MUMPS, general", general, [&] { return MakeLocalSolver(LinearLibrary::kMumps, general); });
  expect("MUMPS, shared", definite, [&] { return MakeSharedSolver(LinearLibrary::kMumps, &communicator); });
}

}  // namespace
}  // namespace nscdd
