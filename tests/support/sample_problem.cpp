// SPDX-License-Identifier: Apache-2.0
#include "sample_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "problem/state.h"
#include "stepping/step_problem.h"

namespace nscdd::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDt = 0.01;

void AddBody(ContactProblem* p, double mass, Twist free_velocity) {
  p->mass.push_back(mass);
  p->inertia.push_back(0.5 * mass);
  p->free_velocity.push_back(free_velocity);
  p->impulse.push_back(std::isinf(mass) ? Wrench{} : Wrench{mass * free_velocity.vx, mass * free_velocity.vy, 0.0});
}

void AddContact(ContactProblem* p, int a, int b, Vec2 n, double friction, int subdomain) {
  p->contacts.a.push_back(a);
  p->contacts.b.push_back(b);
  p->contacts.normal.push_back(n);
  p->contacts.gap.push_back(0.0);
  p->contacts.lever_a.push_back(1.0);
  p->contacts.lever_b.push_back(1.0);
  p->contacts.friction.push_back(friction);
  p->offset.push_back(0.0);
  p->subdomain.push_back(subdomain);
}

}  // namespace

ContactProblem SampleProblem(const SampleOptions& o) {
  std::mt19937 random(11);
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  ContactProblem p;
  for (int i = 0; i < o.rows * o.columns; ++i) AddBody(&p, 1.0 + draw(5), {0.2 * kDt * draw(10), -9.81 * kDt, 0.001 * draw(7)});
  const int wall = o.rows * o.columns;
  AddBody(&p, kInfinity, {});
  const double c = std::cos(std::numbers::pi / 3), s = std::sin(std::numbers::pi / 3);
  for (int y = 0; y < o.rows; ++y) {
    for (int x = 0; x < o.columns; ++x) {
      const int i = x + o.columns * y;
      const auto join = [&](int b, Vec2 n) { AddContact(&p, i, b, n, o.friction, draw(o.subdomains)); };
      if (y == 0) AddContact(&p, wall, i, {0.0, 1.0}, o.friction, draw(o.subdomains));
      if (x == 0) AddContact(&p, wall, i, {1.0, 0.0}, o.friction, draw(o.subdomains));
      if (x + 1 == o.columns) AddContact(&p, wall, i, {-1.0, 0.0}, o.friction, draw(o.subdomains));
      if (x + 1 < o.columns) join(i + 1, {1.0, 0.0});
      if (y + 1 == o.rows) continue;
      // Rows are shifted by half a disk to the right and to the left in turn.
      const int left = y % 2 == 0 ? x - 1 : x;
      if (left >= 0) join(left + o.columns * (y + 1), {-c, s});
      if (left + 1 < o.columns) join(left + 1 + o.columns * (y + 1), {c, s});
    }
  }
  return p;
}

ContactProblem FlowerProblem(int petals) {
  ContactProblem p;
  AddBody(&p, 2.0, {0.05, -0.1, 0.3});
  for (int k = 0; k < petals; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.3) / 6.0;
    const Vec2 n{std::cos(angle), std::sin(angle)};
    AddBody(&p, 1.0, {-0.2 * n.x, -0.2 * n.y, 0.0});
    AddContact(&p, 0, k + 1, n, 0.2, k);
  }
  return p;
}

Sample::Sample(const ContactProblem& p) : source(p) {
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    inverse_mass.push_back(std::isinf(p.mass[i]) ? 0.0 : 1.0 / p.mass[i]);
    inverse_inertia.push_back(std::isinf(p.mass[i]) ? 0.0 : 1.0 / p.inertia[i]);
    body_id.push_back(static_cast<std::int64_t>(i));
  }
  SubdomainContacts chosen;
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    chosen.rows.resize(std::max<std::size_t>(chosen.rows.size(), p.subdomain[c] + 1));
    chosen.rows[p.subdomain[c]].push_back(static_cast<std::int32_t>(c));
  }
  const auto is_free = [&](std::int32_t body) { return inverse_mass[body] > 0.0; };
  sharing = MakeSharing(p.mass.size(), TouchedBodies(p.contacts, chosen, p.mass.size(), is_free));
  const ProblemTables tables{inverse_mass, inverse_inertia, p.free_velocity, &p.contacts, p.offset, &sharing};
  ProblemTotals totals;
  totals.model = RequiredModel(tables);
  totals.scales = {1.0, 1.0, 1.0};
  totals.contacts = static_cast<std::int64_t>(p.contacts.size());
  problem = AssembleProblem(tables, body_id, chosen, totals, Blocks(static_cast<int>(chosen.rows.size()), 1), 0);
}

std::vector<Twist> Sample::GlobalVelocity(const PartitionedState& state) const {
  std::vector<Vec2> r(source.contacts.size()), v(source.contacts.size());
  for (std::size_t e = 0; e < problem.subdomains.size(); ++e) StoreImpulses(problem.subdomains[e], state.subdomains[e], &r, &v);
  std::vector<Twist> velocity = source.free_velocity;
  for (std::size_t c = 0; c < r.size(); ++c) {
    const int a = source.contacts.a[c], b = source.contacts.b[c];
    const Vec2 n = source.contacts.normal[c], t{n.y, -n.x}, p = r[c].x * n + r[c].y * t;
    velocity[a].vx -= inverse_mass[a] * p.x;
    velocity[a].vy -= inverse_mass[a] * p.y;
    velocity[a].spin += inverse_inertia[a] * source.contacts.lever_a[c] * r[c].y;
    velocity[b].vx += inverse_mass[b] * p.x;
    velocity[b].vy += inverse_mass[b] * p.y;
    velocity[b].spin += inverse_inertia[b] * source.contacts.lever_b[c] * r[c].y;
  }
  return velocity;
}

}  // namespace nscdd::test
