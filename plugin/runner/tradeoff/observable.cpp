// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "nscdd/error.h"
#include "scene/text.h"

namespace nscdd {
namespace {

struct Entry {
  const char* name;
  const char* unit;
};
// In the order of the enumerators.
constexpr std::array<Entry, 7> kEntries = {{{"centre_of_mass_x", "m"},
                                            {"centre_of_mass_y", "m"},
                                            {"kinetic_energy", "J"},
                                            {"wall_force", "N"},
                                            {"wall_force_x", "N"},
                                            {"wall_force_y", "N"},
                                            {"flow_rate", "kg/s"}}};

}  // namespace

std::vector<std::string> ObservableNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kEntries) names.emplace_back(entry.name);
  return names;
}

Observable ParseObservable(const std::string& name) {
  const std::vector<std::string> names = ObservableNames();
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) {
    throw Error(fmt::format("--observable: there is no '{}'; {}", name, Suggestion(name, names, "observables")));
  }
  return static_cast<Observable>(at - names.begin());
}

std::string NameOf(Observable observable) { return kEntries[static_cast<std::size_t>(observable)].name; }
std::string UnitOf(Observable observable) { return kEntries[static_cast<std::size_t>(observable)].unit; }

double Evaluate(Observable observable, const StepProblem& step, const Answer& answer, const std::vector<Pose>& end,
                double period) {
  const Vec2 force = (1.0 / step.dt) * ImpulseOnWalls(step.problem, answer.impulse);
  const SampleTotals s = TotalsOf(step.problem, answer.velocity, end);
  const double length = period > 0.0 ? period : s.rightmost - s.leftmost;
  switch (observable) {
    case Observable::kWallForce:
      return Norm(force);
    case Observable::kWallForceX:
      return force.x;
    case Observable::kWallForceY:
      return force.y;
    case Observable::kKineticEnergy:
      return s.kinetic_energy;
    case Observable::kCentreOfMassX:
      return s.centre.x;
    case Observable::kCentreOfMassY:
      return s.centre.y;
    case Observable::kFlowRate:
      break;
  }
  return length > 0.0 ? s.momentum.x / length : 0.0;
}

}  // namespace nscdd
