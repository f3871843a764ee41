#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "contestant.h"
#include "nscdd/communicator.h"
#include "nscdd/error.h"
#include "nscdd/time_stepper.h"
#include "scene/grain_size.h"
#include "scene/gravity.h"
#include "scene/platform.h"
#include "stepping/impulse_cache.h"

namespace nscdd::benchmark {
namespace {

class OurContestant final : public Contestant {
 public:
  OurContestant(const Scene& scene, const StoppingOptions& stopping)
      : scene_(scene),
        platform_(MakePlatform("box2d", scene)),
        stepper_(Stepping(scene), NscdOptions{stopping, {}}, &platform_->adapter(), &communicator_) {
    ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform_->Add(body); });
  }

  PlatformAdapter& adapter() override { return platform_->adapter(); }
  void Step(std::int64_t step) override { Advance(step); }

  MeasuredStep StepAndMeasure(std::int64_t step) override {
    const double dt = scene_.time.dt;
    platform_->SetGravity(GravityAt(scene_.gravity, step, dt));
    const StepProblem problem = ReadStepProblem(&adapter(), dt, AlertDistance(scene_));
    const SolveReport& report = Advance(step).solve;
    MeasuredStep result;
    result.residuals = MeasureAnswer(problem, Velocities(), Impulses(problem), AllContacts(problem));
    result.on_reported = result.residuals;
    result.sweeps = report.sweeps;
    result.candidates = result.reported = report.contacts;
    result.active = report.active;
    CheckAgainstReport(result.residuals.nat, report.residuals.nat, step);
    return result;
  }

 private:
  static SteppingOptions Stepping(const Scene& scene) {
    SteppingOptions options;
    options.alert_distance = AlertDistance(scene);
    return options;
  }

  const StepReport& Advance(std::int64_t step) {
    platform_->SetGravity(GravityAt(scene_.gravity, step, scene_.time.dt));
    return stepper_.Step(scene_.time.dt);
  }

  /// Rows ascend by id in both.
  std::vector<Twist> Velocities() const {
    std::vector<Twist> velocity;
    for (const BodyRecord& body : stepper_.bodies()) velocity.push_back(body.velocity);
    return velocity;
  }

  std::vector<Vec2> Impulses(const StepProblem& problem) const {
    std::map<ContactKey, Vec2> by_key;
    for (const ContactRecord& contact : stepper_.contacts()) by_key[contact.key] = contact.impulse;
    std::vector<Vec2> impulse;
    for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
      impulse.push_back(by_key.at(KeyOf(problem.contacts, c, problem.bodies.id)));
    }
    return impulse;
  }

  /// The yardstick, put to an answer whose residual the core has measured itself.
  static void CheckAgainstReport(double measured, double reported, std::int64_t step) {
    if (std::abs(measured - reported) <= 1e-6 * reported + 1e-12) return;
    throw Error(fmt::format(
        "step {}: nat is {} here and {} in the stepper's report; step_problem.cpp must measure what the core measures.", step,
        measured, reported));
  }

  const Scene& scene_;
  std::unique_ptr<Platform> platform_;
  SerialCommunicator communicator_;
  TimeStepper stepper_;
};

}  // namespace

double AlertDistance(const Scene& scene) { return 0.1 * MeanGrainRadius(scene); }

Entry OurEntry(double tolerance) {
  StoppingOptions stopping;
  stopping.tolerance = tolerance;
  return {fmt::format("nscdd, nat {:.0e}", tolerance),
          [stopping](const Scene& scene) { return std::make_unique<OurContestant>(scene, stopping); }};
}

Entry OurBudgetEntry(int sweeps) {
  StoppingOptions stopping;
  stopping.tolerance = 1e-300;
  stopping.max_iterations = stopping.test_every = sweeps;
  return {fmt::format("nscdd, {} sweeps", sweeps),
          [stopping](const Scene& scene) { return std::make_unique<OurContestant>(scene, stopping); }};
}

}  // namespace nscdd::benchmark
