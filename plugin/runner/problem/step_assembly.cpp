// SPDX-License-Identifier: Apache-2.0
#include "problem/step_assembly.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "nscdd/normal_law.h"
#include "problem/contact_motion.h"

namespace nscdd {
namespace {

void AddBodies(const BodyTable& bodies, double dt, ContactProblem* problem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool free = bodies.kind[i] == BodyKind::kFree;
    const double mass = free ? bodies.mass[i] : kInfinity, inertia = free ? bodies.inertia[i] : kInfinity;
    const Wrench f = free ? bodies.force[i] : Wrench{};
    const Twist& v = bodies.velocity[i];
    problem->mass.push_back(mass);
    problem->inertia.push_back(inertia);
    problem->free_velocity.push_back({v.vx + dt * f.fx / mass, v.vy + dt * f.fy / mass, v.spin + dt * f.torque / inertia});
    problem->impulse.push_back({dt * f.fx, dt * f.fy, dt * f.torque});
  }
}

void AppendRow(const ContactTable& from, std::size_t c, ContactTable* to) {
  to->a.push_back(from.a[c]);
  to->b.push_back(from.b[c]);
  to->shape_a.push_back(from.shape_a[c]);
  to->shape_b.push_back(from.shape_b[c]);
  if (from.has_images()) to->image.push_back(from.image[c]);
  to->gap.push_back(from.gap[c]);
  to->normal.push_back(from.normal[c]);
  to->lever_a.push_back(from.lever_a[c]);
  to->lever_b.push_back(from.lever_b[c]);
  if (from.has_arms()) to->arm_a.push_back(from.arm_a[c]);
  if (from.has_arms()) to->arm_b.push_back(from.arm_b[c]);
  to->site.push_back(from.site[c]);
  to->flat.push_back(from.flat[c]);
  to->friction.push_back(from.friction[c]);
  to->restitution.push_back(from.restitution[c]);
}

}  // namespace

BodyTable SortedById(const BodyTable& bodies) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bodies.id[a] < bodies.id[b]; });
  BodyTable sorted;
  sorted.Resize(bodies.size());
  const auto gather = [&](const auto& from, auto* to) {
    for (std::size_t i = 0; i < order.size(); ++i) (*to)[i] = from[order[i]];
  };
  gather(bodies.id, &sorted.id);
  gather(bodies.kind, &sorted.kind);
  gather(bodies.mass, &sorted.mass);
  gather(bodies.inertia, &sorted.inertia);
  gather(bodies.radius, &sorted.radius);
  gather(bodies.bounding_radius, &sorted.bounding_radius);
  gather(bodies.pose, &sorted.pose);
  gather(bodies.velocity, &sorted.velocity);
  gather(bodies.force, &sorted.force);
  return sorted;
}

ContactProblem AssembleStep(const BodyTable& bodies, const ContactTable& contacts, const SteppingOptions& stepping, double dt) {
  ContactProblem problem;
  AddBodies(bodies, dt, &problem);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (stepping.normal_law == NormalLaw::kStrict && contacts.gap[c] > 0.0) continue;
    AppendRow(contacts, c, &problem.contacts);
    const double approach =
        ContactMotion(contacts, c).Velocity(bodies.velocity[contacts.a[c]], bodies.velocity[contacts.b[c]]).x;
    const double levers = contacts.lever_a[c] + contacts.lever_b[c];
    problem.offset.push_back(NormalOffset(stepping, contacts.gap[c], levers, approach, contacts.restitution[c], dt));
    problem.approach_speed = std::max(problem.approach_speed, -approach);
  }
  return problem;
}

}  // namespace nscdd
