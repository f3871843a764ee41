#include "step_problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nlgs/sweep.h"
#include "nscdd/normal_law.h"
#include "nscdd/options.h"
#include "partition/sharing.h"
#include "problem/subdomain_builder.h"

namespace nscdd::benchmark {
namespace {

bool IsFree(const StepProblem& p, std::size_t row) { return p.bodies.kind[row] == BodyKind::kFree; }

/// V_f = V_i + dt M^-1 f, and the scales of the residuals that loads decide.
void FillBodies(double dt, StepProblem* p) {
  const std::size_t n = p->bodies.size();
  p->inverse_mass.assign(n, 0.0);
  p->inverse_inertia.assign(n, 0.0);
  p->free_velocity = p->bodies.velocity;
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!IsFree(*p, i)) continue;
    const double im = 1.0 / p->bodies.mass[i], ii = 1.0 / p->bodies.inertia[i];
    const Wrench& f = p->bodies.force[i];
    Twist& v = p->free_velocity[i];
    p->inverse_mass[i] = im;
    p->inverse_inertia[i] = ii;
    v = {v.vx + dt * im * f.fx, v.vy + dt * im * f.fy, v.spin + dt * ii * f.torque};
    const double f2 = dt * dt * (f.fx * f.fx + f.fy * f.fy);
    sum += f2;
    p->scales.energy += f2 * im;
    p->scales.velocity = std::max(p->scales.velocity, std::sqrt(f2) * im);
  }
  p->scales.impulse = std::sqrt(sum);
}

/// b_n; the largest approach speed is part of the scale of nat_max. Arms do not matter to it for disks.
std::vector<double> Offsets(double dt, StepProblem* p) {
  const ContactTable& t = p->contacts;
  std::vector<double> offset(t.size());
  for (std::size_t c = 0; c < t.size(); ++c) {
    const Twist &va = p->bodies.velocity[t.a[c]], &vb = p->bodies.velocity[t.b[c]];
    const double approach = Dot(t.normal[c], Linear(vb) - Linear(va));
    offset[c] = NormalOffset(SteppingOptions{}, t.gap[c], t.lever_a[c] + t.lever_b[c], approach, t.restitution[c], dt);
    p->scales.velocity = std::max(p->scales.velocity, -approach);
  }
  return offset;
}

SubdomainState StateOf(const StepProblem& p, const SubdomainProblem& s, const std::vector<Twist>& velocity,
                       const std::vector<Vec2>& impulse) {
  SubdomainState state{s.free_velocity, {}};
  const int dofs = Dofs(s.model);
  for (std::size_t b = 0; b < s.body_count(); ++b) {
    if (p.inverse_mass[s.body[b]] == 0.0) continue;
    const Twist& v = velocity[s.body[b]];
    state.velocity[dofs * b] = v.vx;
    state.velocity[dofs * b + 1] = v.vy;
    if (dofs == 3) state.velocity[dofs * b + 2] = v.spin;
  }
  for (const std::int32_t c : s.contact) {
    state.impulse.push_back(impulse[c].x);
    if (HasFriction(s.model)) state.impulse.push_back(impulse[c].y);
  }
  return state;
}

}  // namespace

StepProblem ReadStepProblem(PlatformAdapter* adapter, double dt, double alert) {
  StepProblem p;
  adapter->ReadBodies(&p.bodies);
  std::vector<Pose> detection = p.bodies.pose;
  for (std::size_t i = 0; i < detection.size(); ++i) {
    const Twist& v = p.bodies.velocity[i];
    detection[i] = {detection[i].x + 0.5 * dt * v.vx, detection[i].y + 0.5 * dt * v.vy, detection[i].angle + 0.5 * dt * v.spin};
  }
  adapter->DetectContacts({p.bodies.id, detection}, alert, &p.contacts);
  FillBodies(dt, &p);
  p.offset = Offsets(dt, &p);
  return p;
}

std::vector<std::int32_t> AllContacts(const StepProblem& p) {
  std::vector<std::int32_t> rows(p.contacts.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

SubdomainProblem BuildSubdomain(const StepProblem& p, std::vector<std::int32_t> contacts) {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const std::int32_t c : contacts) {
    for (const std::int32_t body : {p.contacts.a[c], p.contacts.b[c]}) {
      if (IsFree(p, body)) pairs.emplace_back(body, 0);
    }
  }
  const Sharing sharing = MakeSharing(p.bodies.size(), std::move(pairs));
  const ProblemTables tables{p.inverse_mass, p.inverse_inertia, p.free_velocity, &p.contacts, p.offset, &sharing};
  return SubdomainBuilder(tables, RequiredModel(tables)).Build(0, std::move(contacts));
}

AnswerResiduals MeasureAnswer(const StepProblem& p, const std::vector<Twist>& velocity, const std::vector<Vec2>& impulse,
                              std::vector<std::int32_t> measured) {
  AnswerResiduals answer;
  const SubdomainProblem problem = BuildSubdomain(p, std::move(measured));
  const SubdomainState given = StateOf(p, problem, velocity, impulse);
  const NaturalParts parts = NaturalResidual(problem, given);
  answer.nat = Nat(parts.sum_e2, parts.sum_r2, p.scales);
  answer.nat_max = NatMax(parts.worst, p.scales);
  SubdomainState balanced = given;
  ComputeVelocity(problem, &balanced);
  const int dofs = Dofs(problem.model);
  double sum = 0.0;
  for (std::size_t i = 0; i < given.velocity.size(); i += dofs) {
    const double dx = given.velocity[i] - balanced.velocity[i], dy = given.velocity[i + 1] - balanced.velocity[i + 1];
    sum += dx * dx + dy * dy;
  }
  const auto free_bodies = std::count(p.bodies.kind.begin(), p.bodies.kind.end(), BodyKind::kFree);
  if (sum > 0.0) answer.imbalance = std::sqrt(sum / static_cast<double>(free_bodies)) / p.scales.velocity;
  return answer;
}

Interpenetration MeasureInterpenetration(PlatformAdapter* adapter, double alert) {
  BodyTable bodies;
  ContactTable contacts;
  adapter->ReadBodies(&bodies);
  adapter->DetectContacts({bodies.id, bodies.pose}, alert, &contacts);
  Interpenetration result;
  for (const double gap : contacts.gap) {
    result.mean += std::max(0.0, -gap);
    result.max = std::max(result.max, -gap);
  }
  if (contacts.size() > 0) result.mean /= static_cast<double>(contacts.size());
  return result;
}

}  // namespace nscdd::benchmark
