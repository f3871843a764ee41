#include "tradeoff/step_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "nscdd/error.h"
#include "nscdd/normal_law.h"
#include "tradeoff/contact_motion.h"

namespace nscdd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class T>
void Permute(const std::vector<std::size_t>& order, std::vector<T>* column) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t i : order) sorted.push_back((*column)[i]);
  *column = std::move(sorted);
}

/// M, V_f = V_i + dt M^-1 f and dt f.
void FillBodies(const BodyTable& bodies, double dt, ContactProblem* p) {
  const std::size_t n = bodies.size();
  p->mass.assign(n, kInfinity);
  p->inertia.assign(n, kInfinity);
  p->free_velocity = bodies.velocity;
  p->impulse.assign(n, {});
  for (std::size_t i = 0; i < n; ++i) {
    if (bodies.kind[i] != BodyKind::kFree) continue;
    p->mass[i] = bodies.mass[i];
    p->inertia[i] = bodies.inertia[i];
    const Wrench& f = bodies.force[i];
    p->impulse[i] = {dt * f.fx, dt * f.fy, dt * f.torque};
    Twist& v = p->free_velocity[i];
    v.vx += dt * f.fx / bodies.mass[i];
    v.vy += dt * f.fy / bodies.mass[i];
    v.spin += dt * f.torque / bodies.inertia[i];
  }
}

/// b_n, and the largest approach speed.
void FillOffsets(const BodyTable& bodies, const SteppingOptions& stepping, double dt, ContactProblem* p) {
  const ContactTable& t = p->contacts;
  p->offset.resize(t.size());
  for (std::size_t c = 0; c < t.size(); ++c) {
    const double approach = ContactMotion(t, c).Velocity(bodies.velocity[t.a[c]], bodies.velocity[t.b[c]]).x;
    p->offset[c] = NormalOffset(stepping, t.gap[c], t.lever_a[c] + t.lever_b[c], approach, t.restitution[c], dt);
    p->approach_speed = std::max(p->approach_speed, -approach);
  }
}

ContactKey KeyOf(const ContactTable& t, std::size_t c, const BodyTable& bodies) {
  return {bodies.id[t.a[c]], bodies.id[t.b[c]], t.shape_a[c], t.shape_b[c], t.has_images() ? t.image[c] : 0};
}

}  // namespace

BodyTable ReadSortedBodies(PlatformAdapter* adapter) {
  BodyTable b;
  adapter->ReadBodies(&b);
  std::vector<std::size_t> order(b.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return b.id[i] < b.id[j]; });
  Permute(order, &b.id);
  Permute(order, &b.kind);
  Permute(order, &b.mass);
  Permute(order, &b.inertia);
  Permute(order, &b.radius);
  Permute(order, &b.bounding_radius);
  Permute(order, &b.pose);
  Permute(order, &b.velocity);
  Permute(order, &b.force);
  return b;
}

std::vector<Pose> Drifted(const std::vector<Pose>& pose, const std::vector<Twist>& velocity, double dt,
                          const AdapterDescription& platform) {
  std::vector<Pose> moved = pose;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    Pose& q = moved[i];
    const Twist& v = velocity[i];
    q = {q.x + dt * v.vx, q.y + dt * v.vy, q.angle + dt * v.spin};
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
  adapter->DetectContacts({p.bodies.id, p.detection}, stepping.alert_distance, &p.problem.contacts);
  FillBodies(p.bodies, dt, &p.problem);
  FillOffsets(p.bodies, stepping, dt, &p.problem);
  const ContactTable& t = p.problem.contacts;
  for (std::size_t c = 0; c < t.size(); ++c) p.keys.push_back(KeyOf(t, c, p.bodies));
  return p;
}

}  // namespace nscdd
