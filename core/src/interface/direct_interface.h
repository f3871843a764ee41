// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "interface/augmented_interface.h"

namespace nscdd {

/// The primal problem (sum_E B_E^T M_lambda,E B_E) V~ = sum_E B_E^T y_E over all subdomains.
///
/// With Eigen every rank has the whole matrix and solves it (the same bits on all of them); with MUMPS on several ranks each
/// has the entries of its subdomains, while right-hand side and solution are still complete everywhere. Where a rank's memory
/// does not allow vectors of all bodies, use the conjugate gradient.
class AugmentedInterface::Direct {
 public:
  Direct(const PartitionedProblem& problem, const std::vector<AugmentedSubdomain>& parts, Communicator* communicator,
         KeptSolver* solver);

  /// V~ of each part's nodes, from each part's y_E. Collective.
  std::vector<std::vector<double>> Solve(const std::vector<std::vector<double>>& y);

 private:
  void NumberNodes(const PartitionedProblem& problem);
  void GatherPattern();
  void SetMatrix();
  /// All ranks' numbers in the order of the subdomains.
  std::vector<double> Gather(const std::vector<double>& mine) const;

  const std::vector<AugmentedSubdomain>& parts_;
  Communicator* communicator_;
  KeptSolver* solver_;
  int dofs_;
  int unknowns_ = 0;
  std::vector<std::vector<std::int32_t>> number_;  // of each part's nodes in the primal problem
  std::vector<std::int32_t> all_numbers_;          // of all parts of all ranks
  std::vector<std::int32_t> row_, column_;
  bool pattern_is_set_ = false;
};

}  // namespace nscdd
