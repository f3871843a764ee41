// SPDX-License-Identifier: Apache-2.0
#include "algorithms/option_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "nscdd/error.h"

namespace nscdd {
namespace {

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw Error(sentence);
}

void RequireAtLeast(const char* name, int value, int least) {
  Require(value >= least, fmt::format("{} is {}; it must be at least {}", name, value, least));
}

void Check(const StoppingOptions& o) {
  Require(o.tolerance >= 0.0, fmt::format("tolerance is {}; it must not be negative", o.tolerance));
  RequireAtLeast("max_iterations", o.max_iterations, 1);
  RequireAtLeast("test_every", o.test_every, 1);
  RequireAtLeast("stall_iterations", o.stall_iterations, 1);
}

void Check(const PartitionOptions& p) {
  Require(p.nx >= 1 && p.ny >= 1 && static_cast<std::int64_t>(p.nx) * p.ny <= 1'000'000,
          fmt::format("subdomains is {}x{}; both must be at least 1 and their product at most 1000000", p.nx, p.ny));
  RequireAtLeast("repartition_every", p.repartition_every, 1);
}

void Check(const AugmentedInterfaceOptions& o) {
  Require(o.lambda >= 0.0 && o.lambda <= 1e8,
          fmt::format("lambda is {}; it must be in [0, 1e8]: above, F = y - M_lambda V~ has no digits left", o.lambda));
  Require(o.reference_mass >= 0.0 && std::isfinite(o.reference_mass),
          fmt::format("reference_mass is {} kg; it must not be negative (0: mean mass)", o.reference_mass));
  Require(o.restoring >= 0.0 && o.restoring <= 1.0, fmt::format("restoring is {}; it must be in [0, 1]", o.restoring));
  Require(o.cg_tolerance > 0.0 && o.cg_tolerance < 1.0,
          fmt::format("cg_tolerance is {}; it must be in (0, 1)", o.cg_tolerance));
  RequireAtLeast("cg_max_iterations", o.cg_max_iterations, 1);
}

void Check(const AccelerationOptions& o) {
  Require(o.depth >= 1 && o.depth <= 8, fmt::format("anderson_depth is {}; it must be in 1 to 8", o.depth));
  RequireAtLeast("anderson_every", o.every, 1);
}

void Check(const NscdOptions& o) {
  Check(o.stopping);
  Check(o.acceleration);
}

void Check(const NscddOptions& o) {
  Check(o.stopping);
  Check(o.partition);
  Check(o.acceleration);
  RequireAtLeast("sweeps_per_stage", o.sweeps_per_stage, 1);
}

void Check(const FeaOptions& o) {
  Check(NscddOptions{o.stopping, o.partition, o.sweeps_per_stage, o.acceleration});
  Check(o.interface);
}

void Check(const ReaOptions& o) {
  Check(NscddOptions{o.stopping, o.partition, o.sweeps_per_stage, {}});
  Check(o.interface);
  RequireAtLeast("max_interface_updates", o.max_interface_updates, 1);
}

void Check(const IeaOptions& o) {
  Check(NscddOptions{o.stopping, o.partition, 1, {}});
  Check(o.interface);
  RequireAtLeast("polish_sweeps", o.polish_sweeps, 0);
  RequireAtLeast("closing_updates", o.closing_updates, 0);
}

void Check(const NewtonOptions& o) {
  Check(o.stopping);
  Require(
      o.stopping.criterion == Criterion::kNat || o.stopping.criterion == Criterion::kNatMax,
      "criterion of solver newton must be nat or nat_max: quad, maxm and qm16 measure what a sweep changes, and it has none");
}

}  // namespace

void CheckAlgorithm(const AlgorithmOptions& algorithm) {
  std::visit([](const auto& o) { Check(o); }, algorithm);
}

void CheckStepping(const SteppingOptions& s) {
  Require(s.theta >= 0.5 && s.theta <= 1.0, fmt::format("theta is {}; it must be in [0.5, 1]", s.theta));
  Require(std::isfinite(s.alert_distance), "alert_distance must be finite");
  Require(s.feedback_beta >= 0.0 && s.feedback_beta <= 1.0,
          fmt::format("feedback_beta is {}; it must be in [0, 1]", s.feedback_beta));
  Require(s.feedback_slop >= 0.0, fmt::format("feedback_slop is {} m; it must not be negative", s.feedback_slop));
  Require(s.feedback_cap >= 0.0, fmt::format("feedback_cap is {} m/s; it must not be negative", s.feedback_cap));
}

}  // namespace nscdd
