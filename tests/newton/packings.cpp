// SPDX-License-Identifier: Apache-2.0
// Solver newton on small packings, against plain sweeps of as many iterations:
//     newton_packings [COUNT [TOLERANCE]]
// prints how each that did not converge ended, and a line of totals. Exit code 1: fewer than nine of ten converged, one ended
// worse than the sweeps, or one that did not converge does not say so with the growth of its impulses.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "nscdd/contact_problem.h"
#include "small_packing.h"

namespace {

using namespace nscdd;

SolveReport Solve(const ContactProblem& problem, double tolerance) {
  NewtonOptions o;
  o.stopping.criterion = Criterion::kNatMax;
  o.stopping.tolerance = tolerance;
  return SolveContactProblem(problem, o).report;
}

SolveReport Sweep(const ContactProblem& problem, double tolerance, int sweeps) {
  NscdOptions o;
  o.acceleration.method = Acceleration::kNone;
  o.stopping = {
      .criterion = Criterion::kNatMax, .tolerance = tolerance, .max_iterations = std::max(1, sweeps), .test_every = 1};
  return SolveContactProblem(problem, o).report;
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 500;
  const double tolerance = argc > 2 ? std::atof(argv[2]) : 1e-8;
  int converged = 0, worse = 0, silent = 0;
  std::int64_t iterations = 0, contacts = 0;
  for (int seed = 0; seed < count; ++seed) {
    const ContactProblem problem = test::SmallPacking(static_cast<unsigned>(seed));
    const SolveReport newton = Solve(problem, tolerance), sweeps = Sweep(problem, tolerance, newton.iterations);
    iterations += newton.iterations;
    contacts += newton.contacts;
    if (newton.status == SolveStatus::kConverged) {
      ++converged;
      continue;
    }
    worse += newton.residuals.nat_max > sweeps.residuals.nat_max;
    silent += newton.status != SolveStatus::kStalled || newton.reason.find("|r|_D") == std::string::npos;
    fmt::print("seed {}: {} bodies, {} contacts, {}, nat_max {:.2g} (sweeps {:.2g}); {}\n", seed, problem.mass.size(),
               newton.contacts, NameOf(newton.status), newton.residuals.nat_max, sweeps.residuals.nat_max, newton.reason);
  }
  fmt::print("{} packings of {} contacts: {} reach nat_max {:g} in {} iterations, {} end above as many plain sweeps\n", count,
             contacts, converged, tolerance, iterations, worse);
  return 10 * converged < 9 * count || worse > 0 || silent > 0;
}
