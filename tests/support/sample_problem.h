// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/contact_problem.h"
#include "problem/partitioned_problem.h"

namespace nscdd::test {

struct SampleOptions {
  int columns = 8;
  int rows = 7;
  double friction = 0.3;
  int subdomains = 1;
};

/// A dense sample: a triangular lattice of disks of different masses on a floor between two walls, pressed by tilted gravity;
/// contacts are spread over the subdomains at random.
ContactProblem SampleProblem(const SampleOptions& options);

/// One disk in the middle of `petals` prescribed ones that press on it, every contact in a subdomain of its own.
ContactProblem FlowerProblem(int petals);

/// A problem assembled as the solvers see it.
struct Sample {
  explicit Sample(const ContactProblem& problem);
  /// V_f + M^-1 sum_E H_E r_E with whole masses, computed from the contact table.
  std::vector<Twist> GlobalVelocity(const PartitionedState& state) const;

  const ContactProblem& source;
  std::vector<double> inverse_mass, inverse_inertia;
  std::vector<std::int64_t> body_id;
  Sharing sharing;
  PartitionedProblem problem;
};

}  // namespace nscdd::test
