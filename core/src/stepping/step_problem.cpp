// SPDX-License-Identifier: Apache-2.0
#include "stepping/step_problem.h"

#include <algorithm>
#include <cmath>

#include "nscdd/step_problem.h"
#include "stepping/motion.h"

namespace nscdd {

StepColumns MakeColumns(const BodyTable& bodies, std::span<const Twist> motion, const ContactTable& contacts,
                        const SubdomainContacts& chosen, const SteppingOptions& stepping, double dt) {
  StepColumns columns;
  columns.inverse_mass.reserve(bodies.size());
  columns.inverse_inertia.reserve(bodies.size());
  columns.free_velocity.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const InverseMass inverse = InverseMassOf(bodies, i);
    columns.inverse_mass.push_back(inverse.mass);
    columns.inverse_inertia.push_back(inverse.inertia);
    columns.free_velocity.push_back(FreeVelocity(bodies, i, inverse, dt));
  }
  // Contacts of other ranks' subdomains are in the table too; they are solved there.
  columns.approach.assign(contacts.size(), 0.0);
  columns.offset.assign(contacts.size(), 0.0);
  for (const auto& rows : chosen.rows) {
    for (const std::int32_t c : rows) {
      const NormalCondition normal = NormalConditionOf(stepping, bodies, motion, contacts, c, dt);
      columns.approach[c] = normal.approach;
      columns.offset[c] = normal.offset;
    }
  }
  return columns;
}

void FreeDisplacements(const BodyTable& bodies, std::span<const std::uint8_t> is_hindered, double dt, StepColumns* columns) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!is_hindered[i] && bodies.kind[i] == BodyKind::kFree) columns->free_velocity[i] = FreeMotion(bodies, i, dt);
  }
}

void AddBody(double mass, double inertia, double radius, const Wrench& force, double dt, ProblemPart* part) {
  const double inverse_mass = 1.0 / mass;
  const double turn = std::abs(dt * force.torque);
  const double load2 = dt * dt * (force.fx * force.fx + force.fy * force.fy);
  part->sum.load2 += load2;
  part->sum.energy += load2 * inverse_mass;
  part->sum.turning_energy += turn * turn / inertia;
  part->sum.bodies += 1.0;
  part->sum.radius += radius;
  part->sum.mass += mass;
  part->max.load_speed = std::max({part->max.load_speed, std::sqrt(load2) * inverse_mass, turn / std::sqrt(mass * inertia)});
}

std::vector<ProblemPart> PartsOfBodies(const Population& population, std::span<const std::int32_t> home,
                                       const SubdomainContacts& chosen, double dt, int rank) {
  std::vector<ProblemPart> parts(chosen.rows.size());
  const BodyTable& t = population.bodies;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t.kind[i] != BodyKind::kFree || population.owner[i] != rank) continue;
    AddBody(t.mass[i], t.inertia[i], t.radius[i], t.force[i], dt, &parts[home[i] - chosen.first]);
  }
  return parts;
}

void AddContacts(const SubdomainContacts& chosen, const ContactTable& contacts, const StepColumns& columns,
                 std::vector<ProblemPart>* parts) {
  for (std::size_t e = 0; e < chosen.rows.size(); ++e) {
    ProblemPart& part = (*parts)[e];
    part.sum.contacts += static_cast<double>(chosen.rows[e].size());
    for (const std::int32_t c : chosen.rows[e]) {
      // A negative offset asks for a speed too: that of recovery.
      const double speed = std::max({0.0, -columns.approach[c], -columns.offset[c]});
      part.sum.contact_energy += speed * speed / (columns.inverse_mass[contacts.a[c]] + columns.inverse_mass[contacts.b[c]]);
      part.max.contact_speed = std::max(part.max.contact_speed, speed);
    }
  }
}

ProblemTotals ReduceTotals(std::vector<ProblemPart> parts, ContactModel mine, Communicator* communicator) {
  // One rank's contacts decide for all: every subdomain of a step has the same unknowns.
  parts.front().max.friction = HasFriction(mine);
  parts.front().max.arms = HasArms(mine);
  const auto [sum, max] = ReduceInOrder(parts, communicator);
  ProblemTotals totals;
  totals.model = ModelWith(max.friction > 0.0, max.arms > 0.0);
  totals.scales = {std::sqrt(sum.load2), std::max(max.load_speed, max.contact_speed), sum.energy,
                   std::max(sum.energy + sum.turning_energy, sum.contact_energy)};
  totals.contacts = static_cast<std::int64_t>(sum.contacts);
  totals.bodies = static_cast<std::int64_t>(sum.bodies);
  if (sum.bodies > 0.0) {
    totals.mean_mass = sum.mass / sum.bodies;
    totals.mean_radius = sum.radius / sum.bodies;
  }
  return totals;
}

PartitionedProblem AssembleProblem(const ProblemTables& tables, const std::vector<std::int64_t>& body_id,
                                   const SubdomainContacts& chosen, const ProblemTotals& totals, const Blocks& blocks,
                                   int rank) {
  PartitionedProblem problem;
  problem.model = totals.model;
  // One builder for all subdomains: it keeps its scratch.
  SubdomainBuilder builder(tables, totals.model);
  problem.subdomains.reserve(chosen.rows.size());
  for (std::size_t e = 0; e < chosen.rows.size(); ++e) {
    problem.subdomains.push_back(builder.Build(chosen.first + static_cast<int>(e), chosen.rows[e]));
  }
  problem.interface = MakeInterfaceMap(problem.subdomains, *tables.sharing, blocks, rank);
  problem.scales = totals.scales;
  problem.mean_mass = totals.mean_mass;
  problem.contact_count = totals.contacts;
  problem.subdomain_count = blocks.subdomains();
  problem.contacts = tables.contacts;
  problem.body_id = &body_id;
  return problem;
}

}  // namespace nscdd
