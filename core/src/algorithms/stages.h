// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "algorithms/monitor.h"
#include "interface/augmented_interface.h"
#include "interface/gluing.h"
#include "nlgs/sweep.h"
#include "nscdd/options.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// The two stages that every algorithm of the paper is made of; a schedule says when which is done.
class Stages {
 public:
  /// The plain interface, X dF = [V].
  Stages(const PartitionedProblem& problem, Communicator* communicator, PartitionedState* state);
  /// The augmented one; lambda = 0, or one subdomain: the plain one, no operator is built.
  Stages(const PartitionedProblem& problem, const AugmentedInterfaceOptions& options, Communicator* communicator,
         InterfaceWorkspace* workspace, PartitionedState* state);

  /// Stage 1: `sweeps` NLGS sweeps in every subdomain with F_E fixed. The last one fills statistics() if `measured`, at a cost.
  void SweepSubdomains(int sweeps, bool measured = true);
  /// U and the jumps of the copies.
  void MeasureJump() { gluing_.Measure(state_->subdomains, &jumps_); }
  /// Stage 2, after MeasureJump(): X_lambda F = ..., or X dF = [V] where lambda is zero or `plain`.
  void UpdateInterface(bool plain = false);
  /// The plain stage 2, X dF = [V], whatever lambda: V_E := U. After MeasureJump().
  void GlueMeans() { gluing_.Glue(&state_->subdomains, &state_->interface); }
  /// V_E and U change places on the copies, after MeasureJump().
  void SwapMeans() { gluing_.SwapMeans(&state_->subdomains); }

  /// Each subdomain by itself, F_E fixed: sweeps until `stopping` holds for it or its max_iterations.
  struct LocalResult {
    int sweeps = 0;         ///< of the subdomain that needed most
    bool converged = true;  ///< all did
  };
  LocalResult SolveSubdomains(const StoppingOptions& stopping);

  const Gluing* gluing() const { return &gluing_; }
  const std::vector<SweepStatistics>& statistics() const { return statistics_; }
  const std::vector<JumpPart>& jumps() const { return jumps_; }

  /// Adds the interface's work to the report.
  SolveReport Close(SolveReport report);

 private:
  bool SolveSubdomain(std::size_t e, const StoppingOptions& stopping, int* sweeps);

  const PartitionedProblem& problem_;
  Communicator* communicator_;
  PartitionedState* state_;
  Gluing gluing_;
  std::unique_ptr<AugmentedInterface> augmented_;
  bool is_direct_ = true;
  std::vector<SweepStatistics> statistics_;
  std::vector<JumpPart> jumps_;
  std::vector<std::vector<double>> left_;  // tangential velocities that the local solves left
  std::int64_t updates_ = 0;
};

}  // namespace nscdd
