// SPDX-License-Identifier: Apache-2.0
#include "problem/step_assembly.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "nscdd/step_problem.h"

namespace nscdd {
namespace {

void AddBodies(const BodyTable& bodies, double dt, ContactProblem* problem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool free = bodies.kind[i] == BodyKind::kFree;
    const Wrench f = free ? bodies.force[i] : Wrench{};
    problem->mass.push_back(free ? bodies.mass[i] : kInfinity);
    problem->inertia.push_back(free ? bodies.inertia[i] : kInfinity);
    problem->free_velocity.push_back(FreeVelocity(bodies, i, InverseMassOf(bodies, i), dt));
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
    if (!Sees(stepping.normal_law, contacts.gap[c])) continue;
    const NormalCondition normal = NormalConditionOf(stepping, bodies, contacts, c, dt);
    AppendRow(contacts, c, &problem.contacts);
    problem.offset.push_back(normal.offset);
    problem.approach_speed = std::max(problem.approach_speed, -normal.approach);
  }
  return problem;
}

}  // namespace nscdd
