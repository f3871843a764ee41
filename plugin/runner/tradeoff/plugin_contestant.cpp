// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "nscdd/host/adapter_host.h"
#include "nscdd/host/solver.h"
#include "scene/platform.h"
#include "tradeoff/contestant.h"

namespace nscdd {
namespace {

class PluginContestant final : public Contestant {
 public:
  PluginContestant(const Scene& scene, const std::string& adapter, const SolverRegistry& registry, const Setting& setting)
      : platform_(MakePlatform(adapter, scene)),
        host_(&platform_->adapter()),
        solver_(registry.Create({setting.solver, setting.options, host_.table(), {}})),
        fixed_(setting.Option("tolerance") == "0") {
    ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform_->Add(body); });
  }

  PlatformAdapter& adapter() override { return platform_->adapter(); }
  void SetGravity(Vec2 gravity) override { platform_->SetGravity(gravity); }
  void Step(double dt) override { solver_.Step(dt); }
  Effort LastEffort() const override { return EffortOf(solver_.Report().solve, fixed_); }
  void KeepImpulses(bool) override {}

  const std::map<ContactKey, Vec2>& impulses() override {
    impulses_.clear();
    const TableView t = solver_.Table("contacts");
    const auto a = t.Integer("body_a"), b = t.Integer("body_b");
    const auto shape_a = t.Integer("shape_a"), shape_b = t.Integer("shape_b"), image = t.Integer("image");
    const auto rn = t.Real("impulse_n"), rt = t.Real("impulse_t");
    for (std::size_t c = 0; c < t.rows(); ++c) {
      const ContactKey key{a[c], b[c], static_cast<std::int32_t>(shape_a[c]), static_cast<std::int32_t>(shape_b[c]),
                           static_cast<std::int32_t>(image[c])};
      impulses_[key] = {rn[c], rt[c]};
    }
    return impulses_;
  }

 private:
  std::unique_ptr<Platform> platform_;
  AdapterHost host_;
  Solver solver_;
  bool fixed_;
  std::map<ContactKey, Vec2> impulses_;
};

}  // namespace

Effort EffortOf(const SolveReport& report, bool fixed) {
  Effort effort;
  switch (report.status) {
    case SolveStatus::kConverged:
      effort.status = StepStatus::kConverged;
      break;
    case SolveStatus::kIterationLimit:
      effort.status = fixed ? StepStatus::kFixed : StepStatus::kIterationLimit;
      break;
    case SolveStatus::kStalled:
      effort.status = StepStatus::kStalled;
      break;
    case SolveStatus::kIncomplete:
      effort.status = StepStatus::kIncomplete;
      break;
    case SolveStatus::kDiverged:
      effort.status = StepStatus::kDiverged;
      break;
  }
  effort.reason = report.reason;
  effort.reported_nat = report.residuals.nat;
  effort.sweeps = report.sweeps;
  effort.exchanges = report.interface_updates + report.cg_iterations;
  effort.exchange_bytes = effort.exchanges * report.interface_copies * report.unknowns_per_body * 8;
  return effort;
}

const char* NameOf(StepStatus status) {
  switch (status) {
    case StepStatus::kConverged:
      return "converged";
    case StepStatus::kFixed:
      return "fixed";
    case StepStatus::kIncomplete:
      return "incomplete";
    case StepStatus::kIterationLimit:
      return "iteration_limit";
    case StepStatus::kStalled:
      return "stalled";
    case StepStatus::kDiverged:
      break;
  }
  return "diverged";
}

std::unique_ptr<Contestant> MakePluginContestant(const Scene& scene, const std::string& adapter, const SolverRegistry& registry,
                                                 const Setting& setting) {
  return std::make_unique<PluginContestant>(scene, adapter, registry, setting);
}

}  // namespace nscdd
