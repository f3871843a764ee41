// SPDX-License-Identifier: Apache-2.0
#include "linear/linear_solver.h"

#include <algorithm>
#include <vector>

#include "linear/eigen_solver.h"
#include "linear/mumps_solver.h"
#include "nscdd/error.h"
#include "parallel/mpi_handle.h"

namespace nscdd {
namespace {

/// Distributed MUMPS takes the right-hand side from rank 0 and leaves the solution there.
class SharedMumps final : public LinearSolver {
 public:
  explicit SharedMumps(Communicator* communicator)
      : communicator_(communicator),
        solver_(MakeMumpsSolver(*FortranHandleOf(*communicator), true, Symmetry::kPositiveDefinite)) {}

  bool is_distributed() const override { return true; }
  Symmetry symmetry() const override { return Symmetry::kPositiveDefinite; }
  void Analyse(int n, std::span<const std::int32_t> row, std::span<const std::int32_t> column) override {
    solver_->Analyse(n, row, column);
    counters_ = solver_->counters();
  }
  void Factorise(std::span<const double> values) override {
    solver_->Factorise(values);
    counters_ = solver_->counters();
  }
  void Solve(std::span<double> x) override {
    solver_->Solve(x);
    const auto raw = std::as_writable_bytes(x);
    std::vector<std::byte> bytes(raw.begin(), raw.end());
    communicator_->Broadcast(0, &bytes);
    std::copy(bytes.begin(), bytes.end(), raw.begin());
    counters_ = solver_->counters();
  }

 private:
  Communicator* communicator_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace

void RefuseMatrix(Symmetry symmetry) {
  if (symmetry == Symmetry::kGeneral) throw Error("the matrix is singular, or not finite, to working precision");
  throw Error(
      "the matrix is not positive definite and finite to working precision: lambda times the reference mass is too far above "
      "the "
      "mass of the lightest body in contact; choose a smaller lambda or reference_mass, or lambda_scale = \"contact\"");
}

std::unique_ptr<LinearSolver> MakeLocalSolver(LinearLibrary library, Symmetry symmetry) {
  if (library != LinearLibrary::kMumps) return MakeEigenSolver(symmetry);
  if (!IsMpiInitialised()) {
    throw Error("linear_solver = mumps needs MPI, also on one process: start the program with mpirun -n 1, or choose eigen");
  }
  return MakeMumpsSolver(SelfFortranHandle(), false, symmetry);
}

std::unique_ptr<LinearSolver> MakeSharedSolver(LinearLibrary library, Communicator* communicator) {
  if (library != LinearLibrary::kMumps || communicator->size() == 1) return MakeLocalSolver(library);
  return std::make_unique<SharedMumps>(communicator);
}

}  // namespace nscdd
