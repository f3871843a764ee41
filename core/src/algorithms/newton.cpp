// SPDX-License-Identifier: Apache-2.0
// Not in the paper: high accuracy with friction, one subdomain. An interior point stage, then proximal Newton steps.
#include <algorithm>

#include "algorithms/algorithms.h"
#include "algorithms/monitor.h"
#include "newton/interior_point.h"
#include "newton/proximal_newton.h"
#include "nlgs/sweep.h"

namespace nscdd {
namespace {

/// The two stages; nat_max decides between them, whatever the criterion.
template <class Row>
class NewtonSolve {
 public:
  NewtonSolve(const PartitionedProblem& problem, const std::vector<Row>& rows, const NewtonOptions& options,
              Communicator* communicator, PartitionedState* state)
      : problem_(problem),
        options_(options),
        monitor_(problem, options.stopping, communicator, /*keep_best=*/true),
        rows_(rows),
        system_(problem.subdomains.front(), rows, options.linear_solver),
        state_(state) {}

  SolveReport Run() {
    if (!InteriorStage() && !ProximalStage()) monitor_.GiveUp("neither of its stages can make a step");
    SolveReport report = monitor_.Finish(factorisations_, 0, state_);
    report.analyses = 1;
    report.factorisations = factorisations_;
    return report;
  }

 private:
  bool Test() { return monitor_.Stops(factorisations_, std::vector<SweepStatistics>(1), {}, *state_); }

  /// True when the iteration ends.
  bool InteriorStage() {
    const double scale = problem_.scales.velocity;
    if (scale == 0.0) return false;
    InteriorPoint<Row> interior(problem_.subdomains.front(), rows_, scale, &system_, &state_->subdomains.front());
    // The stage ends when its residual is good enough for the next one, or has not fallen by a tenth in 30 iterations.
    double best = INFINITY;
    int best_at = 0;
    for (int k = 1; k <= options_.interior_iterations; ++k) {
      if (!interior.Step()) return false;
      ++factorisations_;
      if (Test()) return true;
      const double residual = monitor_.residuals().nat_max;
      if (residual < 0.9 * best) {
        best = residual;
        best_at = k;
      }
      if (residual <= options_.interior_residual || k - best_at >= 30) break;
    }
    return false;
  }

  bool ProximalStage() {
    ProximalNewton<Row> proximal(problem_.subdomains.front(), rows_, 1e-4, &system_, &state_->subdomains.front());
    for (;;) {
      int newtons = 0;
      if (!proximal.Step(options_.stopping.max_iterations - factorisations_, &newtons)) return false;
      factorisations_ += newtons;
      if (Test()) return true;
    }
  }

  const PartitionedProblem& problem_;
  NewtonOptions options_;
  Monitor monitor_;
  const std::vector<Row>& rows_;
  BodySystem<Row> system_;
  PartitionedState* state_;
  int factorisations_ = 0;
};

}  // namespace

SolveReport Solve(const PartitionedProblem& problem, const NewtonOptions& options, Communicator* communicator,
                  InterfaceWorkspace*, PartitionedState* state) {
  return VisitRows(problem.subdomains.front(), [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    return NewtonSolve<Row>(problem, rows, options, communicator, state).Run();
  });
}

}  // namespace nscdd
