// SPDX-License-Identifier: Apache-2.0
#include "nscdd/contact_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "algorithms/algorithms.h"
#include "algorithms/monitor.h"
#include "interface/gluing.h"
#include "nlgs/contact_frame.h"
#include "nlgs/sweep.h"
#include "nscdd/error.h"
#include "problem/initial_state.h"
#include "problem/option_checks.h"
#include "problem/subdomain_builder.h"

namespace nscdd {
namespace {

template <class... Arguments>
void Require(bool holds, fmt::format_string<Arguments...> sentence, Arguments&&... arguments) {
  if (!holds) throw Error(fmt::format(sentence, std::forward<Arguments>(arguments)...));
}

void CheckBodies(const ContactProblem& p) {
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

double InverseOf(double mass) { return std::isinf(mass) ? 0.0 : 1.0 / mass; }

ResidualScales Scales(const ContactProblem& p) {
  ResidualScales s;
  double sum = 0.0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (std::isinf(p.mass[i])) continue;
    const double f2 = p.impulse[i].fx * p.impulse[i].fx + p.impulse[i].fy * p.impulse[i].fy;
    sum += f2;
    s.energy += f2 / p.mass[i];
    s.velocity = std::max(s.velocity, std::sqrt(f2) / p.mass[i]);
  }
  s.impulse = std::sqrt(sum);
  s.velocity = std::max(s.velocity, p.approach_speed);
  for (const double offset : p.offset) s.velocity = std::max(s.velocity, -offset);  // speeds of recovery
  return s;
}

double MeanMass(const ContactProblem& p) {
  double sum = 0.0, count = 0.0;
  for (const double mass : p.mass) {
    if (std::isinf(mass)) continue;
    sum += mass;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// Everything of a problem that its solution refers to.
struct Assembly {
  std::vector<double> inverse_mass, inverse_inertia;
  std::vector<std::int64_t> body_id;
  Sharing sharing;
  PartitionedProblem problem;
};

void Assemble(const ContactProblem& p, Assembly* out) {
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    out->inverse_mass.push_back(InverseOf(p.mass[i]));
    out->inverse_inertia.push_back(InverseOf(p.inertia[i]));
  }
  out->body_id.resize(p.mass.size());
  std::iota(out->body_id.begin(), out->body_id.end(), 0);
  const int count = p.subdomain.empty() ? 1 : 1 + *std::max_element(p.subdomain.begin(), p.subdomain.end());
  std::vector<std::vector<std::int32_t>> rows(count);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    const int e = p.subdomain.empty() ? 0 : p.subdomain[c];
    rows[e].push_back(static_cast<std::int32_t>(c));
    for (const std::int32_t body : {p.contacts.a[c], p.contacts.b[c]}) {
      if (out->inverse_mass[body] > 0.0) pairs.emplace_back(body, e);
    }
  }
  out->sharing = MakeSharing(p.mass.size(), pairs);
  const ProblemTables tables{out->inverse_mass, out->inverse_inertia, p.free_velocity, &p.contacts, p.offset, &out->sharing};
  PartitionedProblem& problem = out->problem;
  problem.model = RequiredModel(tables);
  SubdomainBuilder builder(tables, problem.model);
  for (int e = 0; e < count; ++e) problem.subdomains.push_back(builder.Build(e, std::move(rows[e])));
  problem.interface = MakeInterfaceMap(problem.subdomains, out->sharing, Blocks(count, 1), 0);
  problem.scales = Scales(p);
  problem.mean_mass = MeanMass(p);
  problem.contact_count = static_cast<std::int64_t>(p.contacts.size());
  problem.contacts = &p.contacts;
  problem.body_id = &out->body_id;
}

/// The interface impulses that warm impulses of the whole imply: those with which all copies of a body have its velocity.
void GlueCopies(const PartitionedProblem& problem, Communicator* communicator, PartitionedState* state) {
  Gluing gluing(problem.subdomains, problem.interface, communicator);
  std::vector<JumpPart> jumps;
  gluing.Measure(state->subdomains, &jumps);
  gluing.Glue(&state->subdomains, &state->interface);
}

}  // namespace

ContactSolution SolveContactProblem(const ContactProblem& p, const AlgorithmOptions& options, const std::vector<Vec2>& warm) {
  CheckAlgorithm(options);
  CheckBodies(p);
  CheckContacts(p);
  Require(warm.empty() || warm.size() == p.contacts.size(), "contact problem: warm impulses need one entry per contact");
  Assembly assembly;
  Assemble(p, &assembly);
  const PartitionedProblem& problem = assembly.problem;
  SerialCommunicator serial;
  InterfaceWorkspace workspace;
  Require(problem.subdomains.size() == 1 || std::visit(
                                                [](const auto& o) {
                                                  return requires { o.partition; };
                                                },
                                                options),
          "contact problem: nscd and newton solve one subdomain; use nscdd for several");

  ContactSolution solution;
  solution.velocity = p.free_velocity;
  solution.impulse.assign(p.contacts.size(), {});
  solution.relative_velocity.assign(p.contacts.size(), {});
  PartitionedState state = InitialState(problem, warm);
  if (!warm.empty() && !problem.interface.copies.empty()) GlueCopies(problem, &serial, &state);
  solution.report = problem.contact_count == 0
                        ? ReportWithoutContacts(problem)
                        : std::visit([&](const auto& o) { return Solve(problem, o, &serial, &workspace, &state); }, options);
  solution.report.subdomains = static_cast<std::int64_t>(problem.subdomains.size());
  for (std::size_t e = 0; e < problem.subdomains.size(); ++e) {
    StoreVelocities(problem.subdomains[e], state.subdomains[e], assembly.inverse_mass, &solution.velocity);
    StoreImpulses(problem.subdomains[e], state.subdomains[e], &solution.impulse, &solution.relative_velocity);
  }
  return solution;
}

}  // namespace nscdd
