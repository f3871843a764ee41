// SPDX-License-Identifier: Apache-2.0
#include "nscdd/step_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "nscdd/error.h"

namespace nscdd {
namespace {

/// Of every body: V_f, or what moves a body that no contact hinders where displacements are solved for.
std::vector<Twist> FreeVelocities(const BodyTable& bodies, std::span<const Twist> motion, const ContactTable& contacts,
                                  const SteppingOptions& stepping, double dt) {
  std::vector<std::uint8_t> is_hindered(bodies.size(), !HasTwoStages(stepping.normal_law));
  for (std::size_t c = 0; c < contacts.size() && HasTwoStages(stepping.normal_law); ++c) {
    if (Closes(contacts, c, motion, dt)) is_hindered[contacts.a[c]] = is_hindered[contacts.b[c]] = 1;
  }
  std::vector<Twist> free;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool is_whole = is_hindered[i] || bodies.kind[i] != BodyKind::kFree;
    free.push_back(is_whole ? FreeVelocity(bodies, i, InverseMassOf(bodies, i), dt) : FreeMotion(bodies, i, dt));
  }
  return free;
}

void AddBodies(const BodyTable& bodies, double dt, ContactProblem* problem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool free = bodies.kind[i] == BodyKind::kFree;
    const Wrench f = free ? bodies.force[i] : Wrench{};
    problem->mass.push_back(free ? bodies.mass[i] : kInfinity);
    problem->inertia.push_back(free ? bodies.inertia[i] : kInfinity);
    problem->impulse.push_back({dt * f.fx, dt * f.fy, dt * f.torque});
  }
}

void AppendRow(const ContactTable& from, std::size_t c, ContactTable* to) {
  const auto append = [&](auto column) {
    if (!(from.*column).empty()) (to->*column).push_back((from.*column)[c]);  // some are optional
  };
  for (const auto column :
       {&ContactTable::a, &ContactTable::b, &ContactTable::shape_a, &ContactTable::shape_b, &ContactTable::image})
    append(column);
  for (const auto column : {&ContactTable::gap, &ContactTable::lever_a, &ContactTable::lever_b, &ContactTable::moment,
                            &ContactTable::friction, &ContactTable::restitution})
    append(column);
  for (const auto column : {&ContactTable::normal, &ContactTable::arm_a, &ContactTable::arm_b, &ContactTable::site})
    append(column);
  append(&ContactTable::flat);
}

}  // namespace

std::vector<Pose> Drifted(const std::vector<Pose>& pose, const std::vector<Twist>& velocity, double dt,
                          const AdapterDescription& platform) {
  std::vector<Pose> moved;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    moved.push_back(Moved(pose[i], velocity[i], dt));
    double& x = moved.back().x;
    if (platform.period > 0.0) x -= platform.period * std::floor((x - platform.period_origin) / platform.period);
  }
  return moved;
}

BodyTable SortedById(const BodyTable& bodies) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bodies.id[a] < bodies.id[b]; });
  BodyTable sorted;
  sorted.Resize(bodies.size());
  const auto gather = [&](auto column) {
    for (std::size_t i = 0; i < order.size(); ++i) (sorted.*column)[i] = (bodies.*column)[order[i]];
  };
  gather(&BodyTable::id);
  gather(&BodyTable::kind);
  for (const auto column : {&BodyTable::mass, &BodyTable::inertia, &BodyTable::radius, &BodyTable::bounding_radius})
    gather(column);
  gather(&BodyTable::pose);
  gather(&BodyTable::velocity);
  gather(&BodyTable::force);
  return sorted;
}

ContactProblem PoseStep(const BodyTable& bodies, std::span<const Twist> motion, const ContactTable& contacts,
                        const SteppingOptions& stepping, double dt) {
  ContactProblem problem;
  AddBodies(bodies, dt, &problem);
  problem.free_velocity = FreeVelocities(bodies, motion, contacts, stepping, dt);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!Sees(stepping.normal_law, contacts.gap[c])) continue;
    const NormalCondition normal = NormalConditionOf(stepping, bodies, motion, contacts, c, dt);
    AppendRow(contacts, c, &problem.contacts);
    problem.offset.push_back(normal.offset);
    problem.approach_speed = std::max(problem.approach_speed, -normal.approach);
  }
  return problem;
}

BodyTable ReadSortedBodies(PlatformAdapter* adapter) {
  BodyTable bodies;
  adapter->ReadBodies(&bodies);
  return SortedById(bodies);
}

StepProblem ReadStepProblem(PlatformAdapter* adapter, const SteppingOptions& stepping, double dt) {
  if (!(stepping.alert_distance >= 0.0)) throw Error("a step's problem needs an alert distance that is not negative [m]");
  if (HasTwoStages(stepping.normal_law)) {
    throw Error("a step's problem cannot be read with a normal law of two stages; take \"gap\"");
  }
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
  p.problem = PoseStep(p.bodies, {}, contacts, stepping, dt);
  const ContactTable& t = p.problem.contacts;
  for (std::size_t c = 0; c < t.size(); ++c) p.keys.push_back(KeyOf(t, c, p.bodies.id));
  return p;
}

}  // namespace nscdd
