// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "interface/augmented_subdomain.h"
#include "interface/copy_average.h"
#include "interface/gluing.h"
#include "linear/kept_solver.h"
#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Factorised matrices that outlive a step, and what they cost.
struct InterfaceWorkspace {
  std::unique_ptr<KeptSolver> shared;                 // direct: the primal matrix
  std::vector<std::unique_ptr<KeptSolver>> local;     // cg: M_lambda,E of each subdomain
  std::vector<std::unique_ptr<KeptSolver>> interior;  // cg with the Dirichlet preconditioner
};

/// What the augmented interface did in one solve.
struct InterfaceCounters {
  std::int64_t updates = 0;
  std::int64_t cg_iterations = 0;
  std::int64_t cg_failures = 0;  ///< updates in which the conjugate gradient met its iteration limit
  std::int64_t analyses = 0;
  std::int64_t factorisations = 0;
  double seconds = 0.0;
};

/// Stage 2 with the augmented operator. With y_E = R^d + H_E r_E + Lambda G_E v_E (eq. (13), H instead of the printed G: with
/// G' and friction the printed one has another fixed point), the total interface impulse F solves
///     X_lambda F = sum_E A_E M_lambda,E^-1 y_E,     X_lambda = sum_E A_E M_lambda,E^-1 A_E^T,                (13), (14)
/// or, equivalently and without any A, the primal problem
///     (sum_E B_E^T M_lambda,E B_E) V~ = sum_E B_E^T y_E,   F_E = y_E - M_lambda,E V~  on the copies;
/// then V_E := V_E - M~_E^-1 (F_E - F_E^old) on the copies, r_E kept. They do not agree afterwards where lambda > 0.
class AugmentedInterface {
 public:
  /// lambda > 0. Keeps references. Collective with InterfaceSolve::kDirect.
  AugmentedInterface(const PartitionedProblem& problem, const AugmentedInterfaceOptions& options, Communicator* communicator,
                     InterfaceWorkspace* workspace);
  ~AugmentedInterface();

  /// One update after the sweeps. `gluing` has just measured the jump (its means serve the spins). `left`: tangential
  /// velocities that the local solves left, per subdomain and contact; read only if NeedsLeftVelocities(). Collective.
  void Update(const Gluing& gluing, const std::vector<std::vector<double>>& left, PartitionedState* state);

  bool NeedsLeftVelocities() const {
    return options_.compatibility == Compatibility::kFull && options_.local_velocity == LocalVelocity::kLocal;
  }
  const InterfaceCounters& counters() const { return counters_; }

 private:
  class Direct;
  class ConjugateGradient;
  void ApplyChange(const std::vector<double>& change, const Gluing& gluing, PartitionedState* state);

  const PartitionedProblem& problem_;
  AugmentedInterfaceOptions options_;
  InterfaceWorkspace* workspace_;
  std::vector<AugmentedSubdomain> parts_;
  std::unique_ptr<Direct> direct_;
  std::unique_ptr<ConjugateGradient> cg_;
  CopyAverage average_;
  InterfaceCounters counters_;
};

}  // namespace nscdd
