#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "nscdd/platform_adapter.h"
#include "scene/scene.h"
#include "step_problem.h"

namespace nscdd::benchmark {

/// One step's answer on our contacts.
struct MeasuredStep {
  AnswerResiduals residuals;    ///< on all our candidates; where the contestant reported nothing the impulse is zero
  AnswerResiduals on_reported;  ///< on those only for which it reported something
  std::int64_t sweeps = 0;      ///< passes over the contacts
  std::int64_t candidates = 0;  ///< our contacts: gap at q_m <= alert
  std::int64_t reported = 0;    ///< contacts that the contestant reported, impulse zero included
  std::int64_t active = 0;      ///< of them those with r_n > 0
  std::int64_t unmatched = 0;   ///< of these those that are none of our candidates; their impulse is left out
};

/// A scene's bodies in a Box2D world at the first step, and something that moves them.
class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual PlatformAdapter& adapter() = 0;
  /// Step number `step` >= 1 of the scene. Nothing else is done here: this is what is timed.
  virtual void Step(std::int64_t step) = 0;
  /// The same step, and how well its end velocities and impulses solve our contact problem.
  virtual MeasuredStep StepAndMeasure(std::int64_t step) = 0;
};

/// How to begin again from the same start.
struct Entry {
  std::string name;
  std::function<std::unique_ptr<Contestant>(const Scene&)> make;
};

/// Alert distance of both [m]: a tenth of the mean grain radius, the stepper's default.
double AlertDistance(const Scene& scene);

/// TimeStepper with NSCD (test_every and the rest as by default) through the Box2D adapter.
Entry OurEntry(double tolerance);
/// The same, stopped after so many sweeps of each step.
Entry OurBudgetEntry(int sweeps);

/// b2World::Step with these iterations; sleeping off, warm starting on.
Entry Box2dEntry(int velocity_iterations, int position_iterations, bool continuous);

}  // namespace nscdd::benchmark
