// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/observable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nscdd/contact_kinematics.h"
#include "nscdd/error.h"
#include "scene/names.h"

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

struct Sums {
  double mass = 0.0, energy = 0.0, momentum = 0.0, low = 1e300, high = -1e300;
  Vec2 centre;  // times the mass
};

Sums SumOf(const StepProblem& step, const Answer& answer, const std::vector<Pose>& end) {
  Sums s;
  const ContactProblem& p = step.problem;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (std::isinf(p.mass[i])) continue;
    const Twist& v = answer.velocity[i];
    s.mass += p.mass[i];
    s.energy += 0.5 * (p.mass[i] * (v.vx * v.vx + v.vy * v.vy) + p.inertia[i] * v.spin * v.spin);
    s.momentum += p.mass[i] * v.vx;
    s.centre = s.centre + p.mass[i] * Centre(end[i]);
    s.low = std::min(s.low, end[i].x);
    s.high = std::max(s.high, end[i].x);
  }
  return s;
}

Vec2 WallForce(const StepProblem& step, const Answer& answer) {
  const ContactTable& t = step.problem.contacts;
  Vec2 sum;
  for (std::size_t c = 0; c < t.size(); ++c) {
    Wrench a, b;
    AddImpulse(KinematicsOf(t, c), answer.impulse[c], &a, &b);
    if (std::isinf(step.problem.mass[t.a[c]])) sum = sum + Vec2{a.fx, a.fy};
    if (std::isinf(step.problem.mass[t.b[c]])) sum = sum + Vec2{b.fx, b.fy};
  }
  return (1.0 / step.dt) * sum;
}

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
  switch (observable) {
    case Observable::kWallForce:
      return Norm(WallForce(step, answer));
    case Observable::kWallForceX:
      return WallForce(step, answer).x;
    case Observable::kWallForceY:
      return WallForce(step, answer).y;
    default:
      break;
  }
  const Sums s = SumOf(step, answer, end);
  if (s.mass == 0.0) return 0.0;
  switch (observable) {
    case Observable::kCentreOfMassX:
      return s.centre.x / s.mass;
    case Observable::kCentreOfMassY:
      return s.centre.y / s.mass;
    case Observable::kKineticEnergy:
      return s.energy;
    default: {
      const double length = period > 0.0 ? period : s.high - s.low;
      return length > 0.0 ? s.momentum / length : 0.0;
    }
  }
}

}  // namespace nscdd
