// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "interface/augmented_interface.h"
#include "interface/copy_average.h"

namespace nscdd {

/// Projected conjugate gradient on  X_lambda F = sum_E A_E M_lambda,E^-1 y_E  (Algorithms 5 and 6), in the space of the copies:
/// no A. Vectors live on the interface copies; Pi (CopyAverage::Project) takes zero sums per body:
///     X_lambda ~ Pi M_lambda^-1 Pi,  x = F - F^old,  res = Pi M_lambda^-1 (y - F)
///     preconditioners  z = res;  Pi diag(M_lambda) res;  Pi M_lambda,Gamma res (lumped);  Pi S res (Dirichlet: S the Schur
///     complement on the copies)
/// with the recurrences of Chronopoulos and Gear (1989): one reduction per iteration. It begins at the impulse of before, and
/// stops when the jump of the augmented velocities fell by cg_tolerance (the root, not the paper's square).
class AugmentedInterface::ConjugateGradient {
 public:
  ConjugateGradient(const PartitionedProblem& problem, const std::vector<AugmentedSubdomain>& parts,
                    const AugmentedInterfaceOptions& options, Communicator* communicator, InterfaceWorkspace* workspace);

  /// Change of F on the copies (dofs per copy of the map) from each part's y_E less F_E. Collective.
  std::vector<double> Solve(const std::vector<std::vector<double>>& y);

  int iterations() const { return iterations_; }  ///< of the last Solve()
  bool converged() const { return converged_; }

 private:
  void SetMatrices();
  void SetLocalMatrices();
  void Iterate(double target, std::vector<double>* x, std::vector<double>* res);
  std::vector<double> ApplyInverse(const std::vector<double>& x);  // Pi M_lambda^-1 x
  std::vector<double> Precondition(const std::vector<double>& residual);
  std::vector<double> Spread(std::size_t part, const std::vector<double>& x) const;
  void Collect(std::size_t part, const std::vector<double>& nodes, std::vector<double>* x) const;
  struct Products {
    double rz, wz, rr;
  };
  Products Reduce(const std::vector<double>& r, const std::vector<double>& z, const std::vector<double>& w) const;

  const PartitionedProblem& problem_;
  const std::vector<AugmentedSubdomain>& parts_;
  AugmentedInterfaceOptions options_;
  Communicator* communicator_;
  InterfaceWorkspace* workspace_;
  int dofs_;
  CopyAverage average_;
  std::vector<std::vector<std::int32_t>> interior_;  // nodes of each part that are no copies: their number there, else -1
  int iterations_ = 0;
  bool converged_ = false;
};

}  // namespace nscdd
