// SPDX-License-Identifier: Apache-2.0
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
        solver_(registry.Create({setting.solver, setting.options, host_.table(), {}})) {
    ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform_->Add(body); });
  }

  PlatformAdapter& adapter() override { return platform_->adapter(); }
  void SetGravity(Vec2 gravity) override { platform_->SetGravity(gravity); }
  StepProblem Read(const SteppingOptions& stepping, double dt) override {
    return ReadStepProblem(&platform_->adapter(), stepping, dt);
  }
  void Step(double dt) override { solver_.Step(dt); }
  Effort LastEffort() const override { return EffortOf(solver_.Report().solve); }
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

  Snapshot Capture(std::int64_t step) override {
    return {step, ReadSortedBodies(&platform_->adapter()), impulses(), solver_.SaveState()};
  }

  void Put(const Snapshot& snapshot) override {
    PutBodies(snapshot.bodies, platform_.get());
    if (!snapshot.state.empty()) solver_.LoadState(snapshot.state);
  }

 private:
  std::unique_ptr<Platform> platform_;
  AdapterHost host_;
  Solver solver_;
  std::map<ContactKey, Vec2> impulses_;
};

}  // namespace

Effort EffortOf(const SolveReport& report) {
  Effort effort;
  effort.status = report.status;
  effort.reason = report.reason;
  effort.reported_nat = report.residuals.nat;
  effort.sweeps = report.sweeps;
  effort.exchanges = report.interface_updates + report.cg_iterations;
  effort.exchange_bytes = effort.exchanges * report.interface_copies * report.unknowns_per_body * 8;
  return effort;
}

void PutBodies(const BodyTable& bodies, Platform* platform) {
  for (std::size_t i = 0; i < bodies.size(); ++i) platform->Restore(bodies.id[i], bodies.pose[i], bodies.velocity[i]);
}

std::unique_ptr<Contestant> MakePluginContestant(const Scene& scene, const std::string& adapter, const SolverRegistry& registry,
                                                 const Setting& setting) {
  return std::make_unique<PluginContestant>(scene, adapter, registry, setting);
}

}  // namespace nscdd
