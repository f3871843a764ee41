// SPDX-License-Identifier: Apache-2.0
// Not in the paper: high accuracy with friction, one subdomain.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algorithms/algorithms.h"
#include "algorithms/monitor.h"
#include "newton/interior_point.h"
#include "nlgs/residual.h"
#include "nlgs/sweep.h"

namespace nscdd {
namespace {

/// Interior point iterations, begun anew at another pace where they get stuck, and beside them plain sweeps from the state
/// given, one an iteration. The better of the two is tested, so that the answer is never worse than that of as many sweeps.
template <class Row>
class NewtonSolve {
 public:
  NewtonSolve(const PartitionedProblem& problem, const std::vector<Row>& rows, const NewtonOptions& options,
              Communicator* communicator, PartitionedState* state)
      : problem_(problem),
        sample_(problem.subdomains.front()),
        options_(options),
        monitor_(problem, options.stopping, communicator, /*keep_best=*/true),
        rows_(rows),
        system_(sample_, rows, options.linear_solver),
        interior_state_(*state),
        swept_(state) {}

  SolveReport Run() {
    BeginAnew();
    int k = 1;
    for (;; ++k) {
      const bool stepped = StepInterior();
      const SweepStatistics statistics = SweepWithStatistics(sample_, &swept_->subdomains.front());
      const bool interior_leads = stepped && Residual(interior_state_) < Residual(*swept_);
      if (!monitor_.Stops(k, {statistics}, {}, interior_leads ? interior_state_ : *swept_)) continue;
      if (interior_leads) *swept_ = interior_state_;
      break;
    }
    SolveReport report = monitor_.Finish(k, k, swept_);
    report.analyses = 1;
    report.factorisations = factorisations_;
    if (report.status != SolveStatus::kConverged) report.reason += AtBest(report.residuals);
    return report;
  }

 private:
  static constexpr int kPatience = 40;  // iterations without a residual lower by a tenth

  /// What the criterion measures.
  double Residual(const PartitionedState& state) const {
    Residuals residuals;
    SetNatural(NaturalResidual(sample_, state.subdomains.front()), problem_.scales, &residuals);
    return Measure(options_.stopping, residuals);
  }

  /// Which path is followed past a fold depends on the pace; none is best for all problems.
  void BeginAnew() {
    interior_.reset();
    if (problem_.scales.velocity == 0.0 || attempts_ == 30) return;
    constexpr std::array<double, 2> kRaise{10.0, 4.0};
    constexpr std::array<double, 3> kLower{0.5, 0.5, 0.3};
    const InteriorPace pace{std::pow(0.8, attempts_), kRaise[attempts_ % 2], kLower[attempts_ % 3]};
    ++attempts_;
    interior_.emplace(sample_, rows_, problem_.scales.velocity, pace, &system_, &interior_state_.subdomains.front());
    best_ = INFINITY;
    waited_ = 0;
  }

  /// False where there is no step to make.
  bool StepInterior() {
    if (waited_ == kPatience) BeginAnew();
    if (!interior_) return false;
    ++factorisations_;
    if (!interior_->Step()) {
      waited_ = kPatience;
      return false;
    }
    const double residual = NatMax(NaturalResidual(sample_, interior_state_.subdomains.front()).worst, problem_.scales);
    Watch(residual);
    ++waited_;
    if (residual < 0.9 * best_) {
      best_ = residual;
      waited_ = 0;
    }
    return true;
  }

  void Watch(double residual) {
    if (residual > 0.1) return;
    const double norm = interior_->ImpulseNorm();
    if (first_norm_ == 0.0) first_norm_ = norm;
    if (residual < lowest_) {
      lowest_ = residual;
      lowest_norm_ = norm;
    }
  }

  /// Impulses that creep along self-stresses, which change no velocity, grow while the residual hardly falls.
  std::string AtBest(const Residuals& r) const {
    std::string text = fmt::format("; at best nat {:.3g}, nat_max {:.3g}", r.nat, r.nat_max);
    if (first_norm_ == 0.0) return text;
    return text + fmt::format(", |r|_D (D = diag W) {:.3g} times that at nat_max 0.1", lowest_norm_ / first_norm_);
  }

  const PartitionedProblem& problem_;
  const SubdomainProblem& sample_;
  NewtonOptions options_;
  Monitor monitor_;
  const std::vector<Row>& rows_;
  BodySystem<Row> system_;
  PartitionedState interior_state_;
  PartitionedState* swept_;
  std::optional<InteriorPoint<Row>> interior_;
  int attempts_ = 0;
  int factorisations_ = 0;
  double best_ = INFINITY;  // nat_max of this attempt
  int waited_ = 0;
  double lowest_ = INFINITY;  // nat_max of all attempts
  double first_norm_ = 0.0, lowest_norm_ = 0.0;
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
