// SPDX-License-Identifier: Apache-2.0
#include "stepping/meetings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "nscdd/step_problem.h"
#include "parallel/bytes.h"
#include "stepping/final_gap.h"
#include "stepping/motion.h"

namespace nscdd {
namespace {

constexpr double kAside = 0.1;         // of the levers
constexpr double kOverlap = 1e-4;      // of the levers
constexpr double kOverstepped = 1e-2;  // of the levers
constexpr double kOversteppedFast = 2e-4;
constexpr double kLeastRebound = 1e-2;  // of dt f / m
constexpr double kNever = 1e6;          // offset of a contact that may not act, in units of the problem's speed

double Levers(const ContactTable& t, std::size_t c) { return t.lever_a[c] + t.lever_b[c]; }

bool IsClosedAtEnd(const StepTables& tables, std::size_t c, double dt) {
  const double gap = LinearGap(tables.contacts, c, tables.motion, dt) + dt * tables.relative_velocity[c].x;
  return gap <= kClosedGap * Levers(tables.contacts, c);
}

/// v_n before the step [m/s].
double Approach(const BodyTable& bodies, const ContactTable& t, std::size_t c) {
  return RelativeVelocity(KinematicsOf(t, c), bodies.velocity[t.a[c]], bodies.velocity[t.b[c]]).x;
}

bool Rebounds(const BodyTable& bodies, const StepTables& tables, std::size_t c, double dt) {
  const ContactTable& t = tables.contacts;
  if (t.restitution[c] == 0.0 || !IsActive(tables, c, dt)) return false;
  const auto load = [&](std::int32_t row) {
    if (bodies.kind[row] != BodyKind::kFree) return 0.0;
    const Wrench& f = bodies.force[row];
    return dt / bodies.mass[row] * Norm({f.fx, f.fy});
  };
  const double least = std::max(kLeastRebound * std::max(load(t.a[c]), load(t.b[c])), kClosedGap * Levers(t, c) / dt);
  return -t.restitution[c] * Approach(bodies, t, c) > least;
}

/// W of the bodies of one subdomain, by row of its copies: the copies' own, so that it is the same on any number of ranks.
class CopyMotion {
 public:
  CopyMotion(const SubdomainProblem& problem, const SubdomainState& state, const StepTables& tables)
      : problem_(problem), state_(state), tables_(tables) {}

  Twist Of(std::int32_t copy) const {
    const std::int32_t row = problem_.body[copy];
    Twist w = tables_.columns.free_velocity[row];
    if (tables_.columns.inverse_mass[row] == 0.0) return w;
    const int dofs = Dofs(problem_.model);
    const double* v = &state_.velocity[dofs * copy];
    return {v[0], v[1], dofs == 3 ? v[2] : w.spin};
  }

 private:
  const SubdomainProblem& problem_;
  const SubdomainState& state_;
  const StepTables& tables_;
};

/// Velocity of B's centre (of its touching shape) minus A's along t, the levers' part left out [m/s].
double Aside(const ContactTable& t, std::size_t c, const Twist& a, const Twist& b) {
  return RelativeVelocity(KinematicsOf(t, c), a, b).y - t.lever_a[c] * a.spin - t.lever_b[c] * b.spin;
}

bool IsTakenElsewhere(const StepTables& tables, std::size_t c, const Twist& a, const Twist& b, double dt) {
  const ContactTable& t = tables.contacts;
  const double moment = t.MomentOf(c);
  if (!(tables.impulse[c].x > 0.0) || (moment == 0.0 && t.gap[c] <= kClosedGap * Levers(t, c))) return false;
  const double planned = moment == 0.0 ? 0.0 : moment * Aside(t, c, tables.motion[t.a[c]], tables.motion[t.b[c]]);
  return std::abs(dt * (Aside(t, c, a, b) - planned)) > kAside * Levers(t, c);
}

/// Whether the touching point of one of the shapes turns about its body's centre.
bool Turns(const ContactTable& t, std::size_t c, const Twist& a, const Twist& b) {
  const auto turns = [](Vec2 arm, double spin) { return spin != 0.0 && (arm.x != 0.0 || arm.y != 0.0); };
  return t.has_arms() && (turns(t.arm_a[c], a.spin) || turns(t.arm_b[c], b.spin));
}

bool IsOverlapping(const StepTables& tables, std::size_t c, const Twist& a, const Twist& b, const Grid& grid, double dt) {
  const ContactTable& t = tables.contacts;
  if (!Turns(t, c, a, b)) return false;
  const Pose &qa = tables.detection[t.a[c]], &qb = tables.detection[t.b[c]];
  const double moment = t.MomentOf(c) * dt, shift = t.has_images() ? t.image[c] * grid.period() : 0.0;
  const double end = FinalGap(t, c, Moved(qa, tables.motion[t.a[c]], moment), Moved(qb, tables.motion[t.b[c]], moment),
                              Moved(qa, a, dt), Moved(qb, b, dt), shift);
  const double linear = LinearGap(t, c, tables.motion, dt) + dt * RelativeVelocity(KinematicsOf(t, c), a, b).x;
  const double least = kOverlap * Levers(t, c);
  return end < std::min(0.0, t.gap[c]) - least && linear - end > 0.5 * least;
}

/// Whether one of the contact's bodies has another active contact in this subdomain, or contacts in several.
bool IsOneOfSeveral(const StepTables& tables, const SubdomainProblem& p, std::size_t c, double dt) {
  const ContactTable& t = tables.contacts;
  for (const std::int32_t body : {t.a[c], t.b[c]}) {
    if (tables.columns.inverse_mass[body] == 0.0) continue;
    const auto acts_too = [&](std::int32_t k) {
      return static_cast<std::size_t>(k) != c && (t.a[k] == body || t.b[k] == body) && IsActive(tables, k, dt);
    };
    if (tables.sharing.Multiplicity(body) > 1 || std::any_of(p.contact.begin(), p.contact.end(), acts_too)) return true;
  }
  return false;
}

bool IsOverstepped(const StepTables& tables, std::size_t c, double dt) {
  const double start = LinearGap(tables.contacts, c, tables.motion, dt), change = dt * tables.relative_velocity[c].x;
  const double by = std::min(0.0, start) - (start + change), levers = Levers(tables.contacts, c);
  if (by <= kOversteppedFast * levers) return false;
  const ContactTable& t = tables.contacts;
  const double approach = -RelativeVelocity(KinematicsOf(t, c), tables.motion[t.a[c]], tables.motion[t.b[c]]).x;
  return by > kOverstepped * levers || dt * approach > kAside * levers;
}

/// From W_f to V_f, and so from W to V.
void AddRestOfLoads(const BodyTable& bodies, const StepTables& tables, double dt, SubdomainProblem* p, SubdomainState* state) {
  const int dofs = Dofs(p->model);
  for (std::size_t b = 0; b < p->body_count(); ++b) {
    const std::int32_t row = p->body[b];
    if (bodies.kind[row] != BodyKind::kFree || tables.is_hindered[row]) continue;
    const Twist free = FreeMotion(bodies, row, dt), after = FreeVelocity(bodies, row, InverseMassOf(bodies, row), dt);
    const double rest[3] = {after.vx - free.vx, after.vy - free.vy, after.spin - free.spin};
    for (int d = 0; d < dofs; ++d) {
      p->free_velocity[dofs * b + d] += rest[d];
      state->velocity[dofs * b + d] += rest[d];
    }
  }
}

}  // namespace

bool IsActive(const StepTables& tables, std::size_t c, double dt) {
  return tables.impulse[c].x > 0.0 || IsClosedAtEnd(tables, c, dt);
}

NextStage JudgeDisplacements(const PartitionedProblem& problem, const PartitionedState& state, const Population& population,
                             const StepTables& tables, const Grid& grid, double dt, Communicator* communicator) {
  const BodyTable& bodies = population.bodies;
  NextStage next;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    next.detection = next.detection || (population.owner[i] == communicator->rank() &&
                                        Excursion(bodies, i, tables.displacement[i], dt) > tables.reach[i]);
  }
  for (std::size_t e = 0; e < problem.subdomains.size(); ++e) {
    const SubdomainProblem& p = problem.subdomains[e];
    const CopyMotion motion(p, state.subdomains[e], tables);
    VisitRows(p, [&](const auto& rows) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t c = p.contact[k];
        next.rebound = next.rebound || Rebounds(bodies, tables, c, dt);
        next.precision = next.precision || IsOverstepped(tables, c, dt);
        if (next.detection) continue;
        const Twist a = motion.Of(rows[k].a), b = motion.Of(rows[k].b);
        next.detection = IsOverlapping(tables, c, a, b, grid, dt) ||
                         (IsTakenElsewhere(tables, c, a, b, dt) && IsOneOfSeveral(tables, p, c, dt));
      }
    });
  }
  double any[3] = {next.detection ? -1.0 : 0.0, next.precision ? -1.0 : 0.0, next.rebound ? -1.0 : 0.0};
  communicator->AllReduceMin(any);
  return {any[0] < 0.0, any[1] < 0.0, any[2] < 0.0};
}

KnownMotion NextMotion(const Population& population, const StepTables& tables, double dt, Communicator* communicator) {
  const BodyTable& bodies = population.bodies;
  const int me = communicator->rank();
  std::vector<std::int32_t> active(bodies.size(), 0);
  for (const auto& rows : tables.chosen.rows) {
    for (const std::int32_t c : rows) {
      const std::int32_t a = tables.contacts.a[c], b = tables.contacts.b[c];
      const bool turns = Turns(tables.contacts, c, tables.displacement[a], tables.displacement[b]);
      if (!turns && !IsActive(tables, c, dt)) continue;
      active[a] += turns ? 2 : 1;
      active[b] += turns ? 2 : 1;
    }
  }
  std::map<int, std::vector<std::byte>> parcels;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (population.owner[i] == me || active[i] == 0 || bodies.kind[i] != BodyKind::kFree) continue;
    ByteWriter out(&parcels[population.owner[i]]);
    out.Put(bodies.id[i]);
    out.Put(active[i]);
  }
  std::vector<Message> outgoing;
  for (auto& [rank, bytes] : parcels) outgoing.push_back({rank, std::move(bytes)});
  for (const Message& message : communicator->Deliver(std::move(outgoing))) {
    for (ByteReader in(message.bytes); !in.empty();) {
      const auto id = in.Get<std::int64_t>();
      active[population.RowOf(id)] += in.Get<std::int32_t>();
    }
  }
  KnownMotion known;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (population.owner[i] != me) continue;
    const bool turned_aside = bodies.kind[i] == BodyKind::kFree && (active[i] > 1 || tables.sharing.Multiplicity(i) > 1);
    known.id.push_back(bodies.id[i]);
    known.way.push_back(turned_aside ? tables.displacement[i] : tables.motion[i]);
    known.displacement.push_back(tables.displacement[i]);
  }
  return known;
}

void AskForRebounds(const BodyTable& bodies, double dt, StepTables* tables, PartitionedProblem* problem,
                    PartitionedState* state) {
  const ContactTable& t = tables->contacts;
  const double never = kNever * (problem->scales.velocity > 0.0 ? problem->scales.velocity : 1.0);
  for (std::size_t e = 0; e < problem->subdomains.size(); ++e) {
    SubdomainProblem& p = problem->subdomains[e];
    VisitRows(p, [&](auto& rows) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t c = p.contact[k];
        rows[k].offset = IsActive(*tables, c, dt) ? t.restitution[c] * Approach(bodies, t, c) : never;
      }
    });
    AddRestOfLoads(bodies, *tables, dt, &p, &state->subdomains[e]);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    tables->columns.free_velocity[i] = FreeVelocity(bodies, i, InverseMassOf(bodies, i), dt);
  }
}

std::vector<std::uint8_t> HinderedBodies(const StepTables& tables, double dt) {
  std::vector<std::uint8_t> is_hindered(tables.motion.size(), 0);
  const ContactTable& t = tables.contacts;
  for (const auto& rows : tables.chosen.rows) {
    for (const std::int32_t c : rows) {
      if (Closes(t, c, tables.motion, dt)) is_hindered[t.a[c]] = is_hindered[t.b[c]] = 1;
    }
  }
  return is_hindered;
}

std::vector<Twist> VelocitiesOf(const BodyTable& bodies, const StepTables& tables, double dt) {
  std::vector<Twist> velocity = tables.displacement;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    if (bodies.kind[i] != BodyKind::kFree || tables.is_hindered[i]) continue;
    const Twist &w = tables.displacement[i], free = FreeMotion(bodies, i, dt);
    const Twist after = FreeVelocity(bodies, i, InverseMassOf(bodies, i), dt);
    if (w.vx == free.vx && w.vy == free.vy && w.spin == free.spin) {
      velocity[i] = after;  // to the last bit
    } else {
      velocity[i] = {w.vx + (after.vx - free.vx), w.vy + (after.vy - free.vy), w.spin + (after.spin - free.spin)};
    }
  }
  return velocity;
}

}  // namespace nscdd
