// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/step_problem.h"

#include <cmath>

#include "nscdd/error.h"
#include "problem/step_assembly.h"

namespace nscdd {
BodyTable ReadSortedBodies(PlatformAdapter* adapter) {
  BodyTable bodies;
  adapter->ReadBodies(&bodies);
  return SortedById(bodies);
}

std::vector<Pose> Drifted(const std::vector<Pose>& pose, const std::vector<Twist>& velocity, double dt,
                          const AdapterDescription& platform) {
  std::vector<Pose> moved = pose;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    Pose& q = moved[i];
    const Twist& v = velocity[i];
    q = Moved(q, v, dt);
    if (platform.period > 0.0) q.x -= platform.period * std::floor((q.x - platform.period_origin) / platform.period);
  }
  return moved;
}

double DefaultAlertDistance(const BodyTable& bodies) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.kind[i] != BodyKind::kFree) continue;
    sum += bodies.radius[i];
    count += 1.0;
  }
  return count > 0.0 ? 0.1 * sum / count : 0.0;
}

StepProblem ReadStepProblem(PlatformAdapter* adapter, const SteppingOptions& stepping, double dt) {
  if (!(stepping.alert_distance >= 0.0)) throw Error("a step's problem needs an alert distance that is not negative [m]");
  if (stepping.normal_law == NormalLaw::kStrict) {
    throw Error("a step's problem cannot be read with normal_law = \"strict\"; take \"gap\", which keeps the open contacts");
  }
  StepProblem p;
  p.stepping = stepping;
  p.dt = dt;
  p.bodies = ReadSortedBodies(adapter);
  p.detection = Drifted(p.bodies.pose, p.bodies.velocity, (1.0 - stepping.theta) * dt, adapter->Describe());
  ContactTable contacts;
  adapter->DetectContacts({p.bodies.id, p.detection}, stepping.alert_distance, &contacts);
  p.problem = AssembleStep(p.bodies, contacts, stepping, dt);
  const ContactTable& t = p.problem.contacts;
  for (std::size_t c = 0; c < t.size(); ++c) p.keys.push_back(KeyOf(t, c, p.bodies.id));
  return p;
}

}  // namespace nscdd
