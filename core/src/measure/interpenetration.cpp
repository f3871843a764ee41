// SPDX-License-Identifier: Apache-2.0
#include "nscdd/interpenetration.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nscdd {
namespace {

/// Depths at the next detection, by contact key (ascending).
struct KeyedDepths {
  std::vector<ContactKey> key;
  std::vector<double> depth;

  /// And takes it out; 0 if the pair is no candidate any more.
  double Take(const ContactKey& wanted) {
    const auto at = std::lower_bound(key.begin(), key.end(), wanted);
    if (at == key.end() || *at != wanted) return 0.0;
    return std::exchange(depth[static_cast<std::size_t>(at - key.begin())], 0.0);
  }
};

KeyedDepths DetectDepths(PlatformAdapter* adapter, const StepProblem& step, const std::vector<Pose>& poses) {
  ContactTable t;
  adapter->DetectContacts({step.bodies.id, poses}, step.stepping.alert_distance, &t);
  KeyedDepths found;
  for (std::size_t c = 0; c < t.size(); ++c) {
    found.key.push_back(KeyOf(t, c, step.bodies.id));
    found.depth.push_back(Depth(t.gap[c]));
  }
  return found;
}

}  // namespace

double Percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto count = static_cast<double>(values.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(share * count), 1.0, count)) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

Interpenetration MeasureInterpenetration(PlatformAdapter* adapter, const std::vector<std::int64_t>& ids,
                                         const std::vector<Pose>& poses, double alert) {
  ContactTable contacts;
  adapter->DetectContacts({ids, poses}, alert, &contacts);
  Interpenetration result;
  std::vector<double> depths;
  for (const double gap : contacts.gap) {
    depths.push_back(Depth(gap));
    result.mean += depths.back();
    result.max = std::max(result.max, depths.back());
  }
  if (!depths.empty()) result.mean /= static_cast<double>(depths.size());
  result.p99 = Percentile(std::move(depths), 0.99);
  return result;
}

InterpenetrationGrowth MeasureGrowth(PlatformAdapter* adapter, const StepProblem& step, const std::vector<Twist>& velocity,
                                     const std::vector<Pose>& end) {
  const double rest = (1.0 - step.stepping.theta) * step.dt;
  KeyedDepths next = DetectDepths(adapter, step, Drifted(end, velocity, rest, adapter->Describe()));
  const ContactTable& t = step.problem.contacts;
  InterpenetrationGrowth growth;
  const auto add_geometry = [&](double change) {
    growth.geometry_mean += change;
    growth.geometry_max = std::max(growth.geometry_max, change);
  };
  for (std::size_t c = 0; c < t.size(); ++c) {
    const double vn = RelativeVelocity(KinematicsOf(t, c), velocity[t.a[c]], velocity[t.b[c]]).x;
    const double linear = Depth(t.gap[c] + step.dt * vn);
    const double solver = DepthGrowth(t.gap[c], vn, step.dt);
    growth.solver_mean += solver;
    growth.solver_max = std::max(growth.solver_max, solver);
    add_geometry(next.Take(step.keys[c]) - linear);
  }
  for (const double missed : next.depth) {
    if (missed > 0.0) add_geometry(missed);
  }
  const double count = std::max(1.0, static_cast<double>(t.size()));
  growth.solver_mean /= count;
  growth.geometry_mean /= count;
  return growth;
}

}  // namespace nscdd
