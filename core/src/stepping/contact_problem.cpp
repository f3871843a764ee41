// SPDX-License-Identifier: Apache-2.0
#include "nscdd/contact_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "algorithms/algorithms.h"
#include "interface/gluing.h"
#include "nscdd/error.h"
#include "nscdd/option_table.h"
#include "partition/grid.h"
#include "problem/state.h"
#include "stepping/step_problem.h"
#include "stepping/subdomain_contacts.h"

namespace nscdd {
namespace {

template <class... Arguments>
void Require(bool holds, fmt::format_string<Arguments...> sentence, Arguments&&... arguments) {
  if (!holds) throw Error(fmt::format(sentence, std::forward<Arguments>(arguments)...));
}

void CheckBodies(const ContactProblem& p) {
  // mass and inertia +inf go together: a body whose motion is prescribed cannot turn by itself.
  const std::size_t n = p.mass.size();
  Require(p.inertia.size() == n && p.free_velocity.size() == n && p.impulse.size() == n,
          "contact problem: mass, inertia, free_velocity and impulse need one entry per body");
  for (std::size_t i = 0; i < n; ++i) {
    Require(p.mass[i] > 0.0 && p.inertia[i] > 0.0 && std::isinf(p.mass[i]) == std::isinf(p.inertia[i]),
            "contact problem: body {} has mass {} and inertia {}; both are positive, or both +inf if its motion is prescribed",
            i, p.mass[i], p.inertia[i]);
    const Twist& v = p.free_velocity[i];
    const Wrench& f = p.impulse[i];
    Require(std::isfinite(v.vx + v.vy + v.spin) && (std::isinf(p.mass[i]) || std::isfinite(f.fx + f.fy + f.torque)),
            "contact problem: body {} has a velocity or impulse that is not finite", i);
  }
  Require(p.approach_speed >= 0.0 && std::isfinite(p.approach_speed),
          "contact problem: approach_speed is {} m/s; it must be finite and not negative", p.approach_speed);
}

void CheckContact(const ContactProblem& p, std::size_t c) {
  const ContactTable& t = p.contacts;
  const auto bodies = static_cast<std::int32_t>(p.mass.size());
  Require(t.a[c] >= 0 && t.a[c] < bodies && t.b[c] >= 0 && t.b[c] < bodies && t.a[c] != t.b[c],
          "contact problem: contact {} joins bodies {} and {}; there are {} bodies", c, t.a[c], t.b[c], bodies);
  Require(!std::isinf(p.mass[t.a[c]]) || !std::isinf(p.mass[t.b[c]]),
          "contact problem: contact {} joins two prescribed bodies; leave it out", c);
  Require(std::abs(Norm(t.normal[c]) - 1.0) < 1e-9, "contact problem: the normal of contact {} has length {}, not 1", c,
          Norm(t.normal[c]));
  Require(std::isfinite(t.gap[c] + t.lever_a[c] + t.lever_b[c] + p.offset[c]),
          "contact problem: contact {} has a gap, lever or offset that is not finite", c);
  Require(!t.has_arms() || std::isfinite(t.arm_a[c].x + t.arm_a[c].y + t.arm_b[c].x + t.arm_b[c].y),
          "contact problem: contact {} has an arm that is not finite", c);
  Require(t.friction[c] >= 0.0 && std::isfinite(t.friction[c]),
          "contact problem: contact {} has friction {}; it must be finite and not "
          "negative",
          c, t.friction[c]);
  Require(p.subdomain.empty() || (p.subdomain[c] >= 0 && p.subdomain[c] < 1'000'000),
          "contact problem: contact {} is in subdomain {}; numbers go from 0 to 999999", c,
          p.subdomain.empty() ? 0 : p.subdomain[c]);
}

void CheckContacts(const ContactProblem& p) {
  const ContactTable& t = p.contacts;
  const std::size_t n = t.size();
  Require(t.a.size() == n && t.b.size() == n && t.normal.size() == n && t.lever_a.size() == n && t.lever_b.size() == n &&
              t.friction.size() == n && p.offset.size() == n && (p.subdomain.empty() || p.subdomain.size() == n) &&
              t.arm_a.size() == t.arm_b.size() && (t.arm_a.empty() || t.arm_a.size() == n),
          "contact problem: the columns of the contacts differ in length");
  for (std::size_t c = 0; c < n; ++c) CheckContact(p, c);
}

/// Everything of a problem that its solution refers to.
struct Assembly {
  StepColumns columns;
  std::vector<std::int64_t> body_id;
  Sharing sharing;
  PartitionedProblem problem;
};

StepColumns ColumnsOf(const ContactProblem& p) {
  StepColumns columns;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    const bool free = !std::isinf(p.mass[i]);
    columns.inverse_mass.push_back(free ? 1.0 / p.mass[i] : 0.0);
    columns.inverse_inertia.push_back(free ? 1.0 / p.inertia[i] : 0.0);
  }
  columns.free_velocity = p.free_velocity;
  columns.approach.assign(p.contacts.size(), -p.approach_speed);
  columns.offset = p.offset;
  return columns;
}

SubdomainContacts ContactsOf(const ContactProblem& p) {
  const int count = p.subdomain.empty() ? 1 : 1 + *std::max_element(p.subdomain.begin(), p.subdomain.end());
  SubdomainContacts chosen{0, std::vector<std::vector<std::int32_t>>(count)};
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    chosen.rows[p.subdomain.empty() ? 0 : p.subdomain[c]].push_back(static_cast<std::int32_t>(c));
  }
  return chosen;
}

void Assemble(const ContactProblem& p, Communicator* communicator, Assembly* out) {
  const SubdomainContacts chosen = ContactsOf(p);
  const auto is_free = [&](std::int32_t body) { return !std::isinf(p.mass[body]); };
  out->columns = ColumnsOf(p);
  out->body_id.resize(p.mass.size());
  std::iota(out->body_id.begin(), out->body_id.end(), 0);
  out->sharing = MakeSharing(p.mass.size(), TouchedBodies(p.contacts, chosen, p.mass.size(), is_free));
  const ProblemTables tables = TablesOf(out->columns, p.contacts, out->sharing);
  std::vector<ProblemPart> parts(chosen.rows.size());
  // The loads come as impulses dt f: those of a step of 1 s. They serve as scales, which are of no one subdomain.
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (is_free(static_cast<std::int32_t>(i))) AddBody(p.mass[i], p.inertia[i], 0.0, p.impulse[i], 1.0, &parts.front());
  }
  AddContacts(chosen, p.contacts, out->columns, &parts);
  const ProblemTotals totals = ReduceTotals(std::move(parts), RequiredModel(tables), communicator);
  out->problem = AssembleProblem(tables, out->body_id, chosen, totals, Blocks(static_cast<int>(chosen.rows.size()), 1), 0);
}

/// The interface impulses that warm impulses of the whole imply: those with which all copies of a body have its velocity.
void GlueCopies(const PartitionedProblem& problem, Communicator* communicator, PartitionedState* state) {
  Gluing gluing(problem.subdomains, problem.interface, communicator);
  std::vector<JumpPart> jumps;
  gluing.Measure(state->subdomains, &jumps);
  gluing.Glue(&state->subdomains, &state->interface);
}

}  // namespace

std::vector<int> SubdomainsOf(std::span<const Vec2> sites, int nx, int ny) {
  std::vector<int> subdomain;
  if (sites.empty()) return subdomain;
  Vec2 low = sites.front(), high = sites.front();
  for (const Vec2& p : sites) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Grid grid(low, high, nx, ny);
  for (const Vec2& p : sites) subdomain.push_back(grid.CellOf(p));
  return subdomain;
}

ContactSolution SolveContactProblem(const ContactProblem& p, const AlgorithmOptions& options, const std::vector<Vec2>& warm) {
  CheckSettings({{}, options});
  CheckBodies(p);
  CheckContacts(p);
  Require(warm.empty() || warm.size() == p.contacts.size(), "contact problem: warm impulses need one entry per contact");
  SerialCommunicator serial;
  Assembly assembly;
  Assemble(p, &serial, &assembly);
  const PartitionedProblem& problem = assembly.problem;
  InterfaceWorkspace workspace;
  Require(problem.subdomains.size() == 1 || HasPartition(options),
          "contact problem: nscd and newton solve one subdomain; use nscdd for several");

  // Bodies without contact keep V_f; spins that are no unknown too.
  ContactSolution solution;
  solution.velocity = p.free_velocity;
  solution.impulse.assign(p.contacts.size(), {});
  solution.relative_velocity.assign(p.contacts.size(), {});
  PartitionedState state = InitialState(problem, warm);
  if (!warm.empty() && !problem.interface.copies.empty()) GlueCopies(problem, &serial, &state);
  solution.report = SolveAny(problem, options, &serial, &workspace, &state);
  for (std::size_t e = 0; e < problem.subdomains.size(); ++e) {
    StoreVelocities(problem.subdomains[e], state.subdomains[e], assembly.columns.inverse_mass, &solution.velocity);
    StoreImpulses(problem.subdomains[e], state.subdomains[e], &solution.impulse, &solution.relative_velocity);
  }
  return solution;
}

}  // namespace nscdd
