// SPDX-License-Identifier: Apache-2.0
#include "stepping/midway.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nscdd/step_problem.h"
#include "stepping/meetings.h"

namespace nscdd {
namespace {

/// What the active contacts of a body leave free.
struct Freedom {
  enum Kind : std::uint8_t { kAll, kAlong, kNone } kind = kAll;
  Vec2 normal;  // kAlong: of its contacts
};

void Hinder(Vec2 normal, Vec2 arm, Freedom* freedom) {
  const bool is_same = freedom->kind == Freedom::kAlong && std::abs(Cross(freedom->normal, normal)) < 1e-12;
  const bool has_arm = arm.x != 0.0 || arm.y != 0.0;
  if (has_arm || freedom->kind == Freedom::kNone || (freedom->kind == Freedom::kAlong && !is_same)) {
    freedom->kind = Freedom::kNone;
  } else {
    *freedom = {Freedom::kAlong, normal};
  }
}

std::vector<Freedom> FreedomsOf(const StepTables& tables, double dt) {
  const ContactTable& t = tables.contacts;
  std::vector<Freedom> freedom(tables.displacement.size());
  for (const auto& rows : tables.chosen.rows) {
    for (const std::int32_t c : rows) {
      if (!IsActive(tables, c, dt)) continue;
      Hinder(t.normal[c], t.has_arms() ? t.arm_a[c] : Vec2{}, &freedom[t.a[c]]);
      Hinder(t.normal[c], t.has_arms() ? t.arm_b[c] : Vec2{}, &freedom[t.b[c]]);
    }
  }
  return freedom;
}

/// Half of what the body was accelerated by, backwards, in the free directions.
Twist HalfBack(const Freedom& freedom, const Twist& before, const Twist& after) {
  if (freedom.kind == Freedom::kNone) return {};
  Vec2 change = Linear(before) - Linear(after);
  if (freedom.kind == Freedom::kAlong) change = change - Dot(change, freedom.normal) * freedom.normal;
  return {0.5 * change.x, 0.5 * change.y, 0.5 * (before.spin - after.spin)};
}

}  // namespace

void MoveMidway(const Population& population, double dt, int rank, StepTables* tables) {
  const BodyTable& bodies = population.bodies;
  const std::vector<Freedom> freedom = FreedomsOf(*tables, dt);
  std::vector<Twist> back(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool is_ours = bodies.kind[i] == BodyKind::kFree && population.owner[i] == rank && tables->is_hindered[i] &&
                         tables->sharing.Multiplicity(i) == 1 && tables->sharing.Of(i)[0] == tables->home[i];
    if (is_ours) back[i] = HalfBack(freedom[i], bodies.velocity[i], tables->displacement[i]);
  }
  const ContactTable& t = tables->contacts;
  for (const auto& rows : tables->chosen.rows) {
    for (const std::int32_t c : rows) {
      if (IsActive(*tables, c, dt)) continue;
      const ContactKinematics h = KinematicsOf(t, c);
      const double of_a = RelativeVelocity(h, back[t.a[c]], {}).x, of_b = RelativeVelocity(h, {}, back[t.b[c]]).x;
      const double gap = LinearGap(t, c, tables->motion, dt) + dt * tables->relative_velocity[c].x;
      if (gap + dt * (std::min(0.0, of_a) + std::min(0.0, of_b)) < 0.0) back[t.a[c]] = back[t.b[c]] = {};
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Twist& w = tables->displacement[i];
    w = {w.vx + back[i].vx, w.vy + back[i].vy, w.spin + back[i].spin};
  }
}

}  // namespace nscdd
