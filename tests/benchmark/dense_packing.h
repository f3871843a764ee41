// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "problem/subdomain_problem.h"
namespace nscdd::benchmark {

/// A dense sample in the middle of a solve.
struct DensePacking {
  SubdomainProblem problem;
  SubdomainState state;  ///< after some hundred sweeps from r = 0: a typical active set
  double active = 0.0;   ///< share of the contacts with r_n > 0
};

/// `disks` disks on a jittered hexagonal lattice in an open box under gravity, just tighter than touching, detected by the
/// reference adapter. Deterministic.
DensePacking MakeDensePacking(int disks, double friction);

}  // namespace nscdd::benchmark
