// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/communicator.h"
#include "nscdd/contact_table.h"
#include "nscdd/options.h"
#include "parallel/ordered_reduction.h"
#include "partition/grid.h"
#include "partition/population.h"
#include "partition/sharing.h"
#include "problem/partitioned_problem.h"
#include "problem/subdomain_builder.h"
#include "stepping/subdomain_contacts.h"

namespace nscdd {

/// What the balance equation and the contact law of one step need beside H, by row of this rank's tables:
///     V = V_f + M^-1 H r,   0 <= v_n + b_n _|_ r_n >= 0.
struct StepColumns {
  std::vector<double> inverse_mass;     ///< 1/M of each body; 0: prescribed
  std::vector<double> inverse_inertia;  ///< 1/I
  std::vector<Twist> free_velocity;     ///< V_f
  std::vector<double> approach;         ///< v_n before the step, of each contact [m/s]
  std::vector<double> offset;           ///< b_n [m/s]
};

/// nscdd/step_problem.h applied to every body and to the chosen contacts; `motion` of the sweep.
StepColumns MakeColumns(const BodyTable& bodies, std::span<const Twist> motion, const ContactTable& contacts,
                        const SubdomainContacts& chosen, const SteppingOptions& stepping, double dt);

/// Of the displacements W in two stages: V_f where a body is hindered, so that W is its velocity at the end as well, and what
/// moves it exactly where nothing does.
void FreeDisplacements(const BodyTable& bodies, std::span<const std::uint8_t> is_hindered, double dt, StepColumns* columns);

/// One subdomain's part of what all ranks must know before they build.
struct ProblemSums {
  double load2;           // |dt f|^2 [N^2 s^2]
  double energy;          // |dt f|^2 / m [J]
  double turning_energy;  // (dt torque)^2 / I [J]
  double contact_energy;  // m' v^2 [J] of approach or recovery
  double contacts;
  double bodies;
  double radius, mass;
};
struct ProblemMaxima {
  double load_speed;      // |dt f| / m, |dt torque| / sqrt(m I) [m/s]
  double contact_speed;   // of approach or recovery [m/s]
  double friction, arms;  // 1: some contact has it
};
using ProblemPart = ReductionPart<ProblemSums, ProblemMaxima>;

/// A free body, in the part of its home subdomain.
void AddBody(double mass, double inertia, double radius, const Wrench& force, double dt, ProblemPart* part);
/// The parts of this rank's subdomains from the bodies that it owns; `home`: cell of each.
std::vector<ProblemPart> PartsOfBodies(const Population& population, std::span<const std::int32_t> home,
                                       const SubdomainContacts& chosen, double dt, int rank);
/// Adds their contacts.
void AddContacts(const SubdomainContacts& chosen, const ContactTable& contacts, const StepColumns& columns,
                 std::vector<ProblemPart>* parts);

/// The same on all ranks.
struct ProblemTotals {
  ContactModel model = ContactModel::kNormal;
  ResidualScales scales;
  std::int64_t contacts = 0, bodies = 0;
  double mean_mass = 0.0;    ///< [kg]
  double mean_radius = 0.0;  ///< [m]
};

/// `parts`: one per subdomain of this rank; `mine`: the model that its tables require. Collective.
ProblemTotals ReduceTotals(std::vector<ProblemPart> parts, ContactModel mine, Communicator* communicator);

inline ProblemTables TablesOf(const StepColumns& columns, const ContactTable& contacts, const Sharing& sharing) {
  return {columns.inverse_mass, columns.inverse_inertia, columns.free_velocity, &contacts, columns.offset, &sharing};
}

/// The partitioned problem of these tables. Keeps pointers to the contacts and ids.
PartitionedProblem AssembleProblem(const ProblemTables& tables, const std::vector<std::int64_t>& body_id,
                                   const SubdomainContacts& chosen, const ProblemTotals& totals, const Blocks& blocks,
                                   int rank);

}  // namespace nscdd
