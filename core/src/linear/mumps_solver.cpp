// SPDX-License-Identifier: Apache-2.0
#include "linear/mumps_solver.h"

#include <dmumps_c.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "nscdd/error.h"

namespace nscdd {
namespace {

// Jobs and settings by their numbers in the MUMPS 5.5 users' guide.
constexpr int kInitialise = -1, kTerminate = -2, kAnalyse = 1, kFactorise = 2, kSolve = 3;

/// INFOG(1) and INFOG(2) in words.
std::string Explain(int code, int detail) {
  switch (code) {
    case -3:
      return "called out of order";
    case -5:
    case -7:
    case -13:
      return "not enough memory; use interface = cg or more ranks";
    case -8:
    case -9:
      return "its work space was too small even after enlarging; choose linear_solver = eigen";
    default:
      return fmt::format("see INFOG(1) = {}, INFOG(2) = {} in its users' guide", code, detail);
  }
}

class MumpsSolver final : public LinearSolver {
 public:
  MumpsSolver(int fortran_communicator, bool distributed, Symmetry symmetry) : distributed_(distributed), symmetry_(symmetry) {
    id_.comm_fortran = fortran_communicator;
    id_.par = 1;
    id_.sym = symmetry == Symmetry::kPositiveDefinite ? 1 : 0;
    id_.job = kInitialise;
    dmumps_c(&id_);
    Check("initialisation");
    for (const int stream : {1, 2, 3}) Control(stream) = -1;  // it prints nothing
    Control(4) = 0;
    Control(7) = 0;                      // order of elimination: approximate minimum degree,
    Control(28) = 1;                     // found on one rank
    Control(14) = 50;                    // [%] room beyond the estimate
    Control(18) = distributed_ ? 3 : 0;  // entries given by all ranks, or by rank 0
  }
  ~MumpsSolver() override {
    id_.job = kTerminate;
    dmumps_c(&id_);
  }
  MumpsSolver(const MumpsSolver&) = delete;
  MumpsSolver& operator=(const MumpsSolver&) = delete;

  bool is_distributed() const override { return distributed_; }
  Symmetry symmetry() const override { return symmetry_; }

  void Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) override {
    ++counters_.analyses;
    row_.assign(row.begin(), row.end());
    column_.assign(column.begin(), column.end());
    for (auto* list : {&row_, &column_}) {
      for (int& index : *list) ++index;  // Fortran counts from 1
    }
    values_.assign(row.size(), 0.0);
    id_.n = n;
    PassEntries();
    Run(kAnalyse, "analysis");
  }

  void Factorise(std::span<const double> values) override {
    ++counters_.factorisations;
    values_.assign(values.begin(), values.end());
    PassEntries();
    for (;;) {
      id_.job = kFactorise;
      dmumps_c(&id_);
      const int code = id_.infog[0];
      if ((code != -8 && code != -9) || Control(14) > 1000) break;
      Control(14) *= 2;
    }
    const int code = id_.infog[0];
    // With SYM = 1 an indefinite matrix is factorised without a word: INFOG(12) counts its negative pivots.
    const bool indefinite = symmetry_ == Symmetry::kPositiveDefinite && id_.infog[11] > 0;
    if (code == -6 || code == -10 || code == -40 || (code >= 0 && indefinite)) RefuseMatrix(symmetry_);
    Check("factorisation");
  }

  void Solve(std::span<double> x) override {
    ++counters_.solves;
    id_.rhs = x.data();
    id_.nrhs = 1;
    id_.lrhs = id_.n;
    Run(kSolve, "solution");
  }

 private:
  MUMPS_INT& Control(int number) { return id_.icntl[number - 1]; }

  void PassEntries() {
    const auto count = static_cast<MUMPS_INT8>(row_.size());
    if (distributed_) {
      id_.nnz_loc = count;
      id_.irn_loc = row_.data();
      id_.jcn_loc = column_.data();
      id_.a_loc = values_.data();
    } else {
      id_.nnz = count;
      id_.irn = row_.data();
      id_.jcn = column_.data();
      id_.a = values_.data();
    }
  }

  void Run(int job, const char* what) {
    id_.job = job;
    dmumps_c(&id_);
    Check(what);
  }

  void Check(const char* what) const {
    if (id_.infog[0] >= 0) return;
    throw Error(fmt::format("MUMPS, {}: {}", what, Explain(id_.infog[0], id_.infog[1])));
  }

  bool distributed_;
  Symmetry symmetry_;
  DMUMPS_STRUC_C id_{};
  std::vector<MUMPS_INT> row_, column_;
  std::vector<double> values_;
};

}  // namespace

std::unique_ptr<LinearSolver> MakeMumpsSolver(int fortran_communicator, bool distributed, Symmetry symmetry) {
  return std::make_unique<MumpsSolver>(fortran_communicator, distributed, symmetry);
}

}  // namespace nscdd
