// SPDX-License-Identifier: Apache-2.0
#include "stepping/step_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "nscdd/agreement.h"
#include "nscdd/error.h"
#include "nscdd/normal_law.h"
#include "parallel/ordered_reduction.h"
#include "stepping/motion.h"

namespace nscdd {
namespace {

struct StepSums {
  double kinetic_energy;
  double momentum_x, momentum_y;
  double interpenetration;
  double injected_energy;
  double beyond_reach;
};
struct StepMaxima {
  double beyond_reach;  // 1 + id of a body that is
  double interpenetration;
  double drift;
  double not_finite;  // 1: some number is not
};
using StepPart = ReductionPart<StepSums, StepMaxima>;

void AddBodies(const Population& population, const StepTables& tables, const SteppingOptions& stepping, double dt,
               double mean_radius, int rank, std::vector<StepPart>* parts) {
  const BodyTable& t = population.bodies;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t.kind[i] != BodyKind::kFree || population.owner[i] != rank) continue;
    StepPart& part = (*parts)[tables.home[i] - tables.chosen.first];
    const Twist& v = tables.velocity[i];
    part.sum.kinetic_energy += 0.5 * (t.mass[i] * (v.vx * v.vx + v.vy * v.vy) + t.inertia[i] * v.spin * v.spin);
    part.sum.momentum_x += t.mass[i] * v.vx;
    part.sum.momentum_y += t.mass[i] * v.vy;
    const bool has_displacement = !tables.displacement.empty();
    const Vec2 drift = has_displacement ? dt * Linear(tables.displacement[i])
                                        : (1.0 - stepping.theta) * dt * Linear(t.velocity[i]) + stepping.theta * dt * Linear(v);
    part.max.drift = std::max(part.max.drift, std::sqrt(Dot(drift, drift)));
    // One stage: beyond a radius a thin wall may lie behind the body when contacts are sought, whatever the alert distance.
    const double reach = has_displacement ? tables.reach[i] : std::min(2.0 * tables.reach[i], mean_radius);
    if ((has_displacement ? Excursion(t, i, tables.displacement[i], dt) : Norm(drift)) <= reach) continue;
    part.sum.beyond_reach += 1.0;
    part.max.beyond_reach = std::max(part.max.beyond_reach, 1.0 + static_cast<double>(t.id[i]));
  }
}

void AddContacts(const StepTables& tables, const ContactResults& results, const SteppingOptions& stepping, double dt,
                 std::vector<StepPart>* parts) {
  for (std::size_t k = 0; k < results.size(); ++k) {
    StepPart& part = (*parts)[results.subdomain[k] - tables.chosen.first];
    const double interpenetration = std::max(0.0, -results.final_gap[k]);
    part.sum.interpenetration += interpenetration;
    part.max.interpenetration = std::max(part.max.interpenetration, interpenetration);
    if (HasTwoStages(stepping.normal_law)) continue;
    // The work bound of gap feedback alone: b_n without restitution.
    const double offset = NormalOffset(stepping, results.gap[k], 0.0, 0.0, 0.0, dt);
    part.sum.injected_energy += results.impulse[k].x * std::max(0.0, -offset);
  }
}

}  // namespace

void Summarise(const Population& population, const StepTables& tables, const StepOutcome& outcome,
               const SteppingOptions& stepping, double dt, Communicator* communicator, StepReport* report) {
  // Bodies are summed by home cell, contacts by subdomain: the order of both is that of the subdomains.
  std::vector<StepPart> parts(tables.chosen.rows.size());
  AddBodies(population, tables, stepping, dt, report->mean_radius, communicator->rank(), &parts);
  AddContacts(tables, outcome.contacts, stepping, dt, &parts);
  const std::size_t bad = outcome.FirstNotFinite();
  parts.front().max.not_finite = bad < outcome.bodies.size() ? 1.0 : 0.0;
  const auto [sum, max] = ReduceInOrder(parts, communicator);
  if (max.not_finite > 0.0) {
    RunTogether(communicator, [&] {
      if (bad == outcome.bodies.size()) return;
      throw Error(fmt::format("the solver made a position or velocity of body {} that is not finite; nothing was written back",
                              outcome.bodies.id[bad]));
    });
  }
  const auto contacts = static_cast<double>(report->solve.contacts);
  report->kinetic_energy = sum.kinetic_energy;
  report->momentum_x = sum.momentum_x;
  report->momentum_y = sum.momentum_y;
  report->mean_interpenetration = contacts > 0.0 ? sum.interpenetration / contacts : 0.0;
  report->max_interpenetration = max.interpenetration;
  report->injected_energy = sum.injected_energy;
  report->max_drift = max.drift;
  report->beyond_reach = static_cast<std::int64_t>(sum.beyond_reach);
  report->beyond_reach_body = static_cast<std::int64_t>(max.beyond_reach) - 1;
}

void AddSolve(const SolveReport& earlier, SolveReport* last) {
  last->iterations += earlier.iterations;
  last->sweeps += earlier.sweeps;
  last->interface_updates += earlier.interface_updates;
  last->extrapolations += earlier.extrapolations;
  last->acceleration_restarts += earlier.acceleration_restarts;
  last->cg_iterations += earlier.cg_iterations;
  last->cg_failures += earlier.cg_failures;
  last->analyses += earlier.analyses;
  last->factorisations += earlier.factorisations;
  last->seconds_interface += earlier.seconds_interface;
  if (IsAsAsked(earlier.status) || !IsAsAsked(last->status)) return;
  last->status = earlier.status;
  last->reason = earlier.reason;
  last->residuals = earlier.residuals;
}

void SummariseCommunication(const CommunicationCounters& mine, std::int64_t migrated, Communicator* communicator,
                            StepReport* report) {
  report->migrated_bodies = migrated;
  if (communicator->size() == 1) return;
  report->collectives = mine.collectives + 1;  // with this one
  struct Sent {
    double messages, bytes, migrated;
  };
  const Sent all =
      ReduceInOrder(
          std::vector<ReductionPart<Sent>>{
              {{static_cast<double>(mine.messages), static_cast<double>(mine.bytes), static_cast<double>(migrated)}, {}}},
          communicator)
          .sum;
  report->messages = static_cast<std::int64_t>(all.messages);
  report->message_bytes = static_cast<std::int64_t>(all.bytes);
  report->migrated_bodies = static_cast<std::int64_t>(all.migrated);
}

}  // namespace nscdd
