// SPDX-License-Identifier: Apache-2.0
#include "stepping/step_outcome.h"

#include <cmath>

#include "stepping/final_gap.h"

namespace nscdd {
namespace {

bool IsFinite(const Pose& q, const Twist& v) {
  return std::isfinite(q.x + q.y + q.angle) && std::isfinite(v.vx + v.vy + v.spin);
}

const std::vector<Twist>& Motion(const StepTables& tables) {
  return tables.displacement.empty() ? tables.velocity : tables.displacement;
}

template <class... Columns>
void Reserve(std::size_t count, Columns*... columns) {
  (columns->reserve(count), ...);
}

void AddBodies(const Population& population, const StepTables& tables, const Grid& grid, double rest, int rank,
               BodyResults* out) {
  const BodyTable& t = population.bodies;
  Reserve(t.size(), &out->id, &out->kind, &out->radius, &out->pose, &out->velocity, &out->multiplicity, &out->subdomain);
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (population.owner[i] != rank) continue;
    const Twist& v = tables.velocity[i];
    Pose end = grid.Wrapped(Moved(tables.detection[i], Motion(tables)[i], rest));
    if (t.kind[i] != BodyKind::kFree && v.vx == 0.0) end.x = t.pose[i].x;  // a standing wall stays where its host has it
    out->id.push_back(t.id[i]);
    out->kind.push_back(t.kind[i]);
    out->radius.push_back(t.radius[i]);
    out->pose.push_back(end);
    out->velocity.push_back(v);
    out->multiplicity.push_back(tables.sharing.Multiplicity(i));
    out->subdomain.push_back(tables.home[i]);
  }
}

void AddContact(const Population& population, const StepTables& tables, const Grid& grid, double rest, std::int32_t c,
                ContactResults* out) {
  const ContactTable& t = tables.contacts;
  const std::int32_t a = t.a[c], b = t.b[c];
  Pose qa = tables.detection[a], qb = tables.detection[b];
  // Positions without the wrap at the period's ends, so that distances stay those of this image.
  const Pose end_a = Moved(qa, Motion(tables)[a], rest), end_b = Moved(qb, Motion(tables)[b], rest);
  if (const double moment = t.MomentOf(c) * rest; moment > 0.0) {
    qa = Moved(qa, tables.motion[a], moment);
    qb = Moved(qb, tables.motion[b], moment);
  }
  const double shift = t.has_images() ? t.image[c] * grid.period() : 0.0;
  out->key.push_back(KeyOf(t, c, population.bodies.id));
  out->gap.push_back(t.gap[c]);
  out->final_gap.push_back(FinalGap(t, c, qa, qb, end_a, end_b, shift));
  out->normal.push_back(t.normal[c]);
  out->point.push_back(Centre(qa) + (t.has_arms() ? t.arm_a[c] : Vec2{}) + t.lever_a[c] * t.normal[c]);
  out->lever_a.push_back(t.lever_a[c]);
  out->lever_b.push_back(t.lever_b[c]);
  out->impulse.push_back(tables.impulse[c]);
  out->relative_velocity.push_back(tables.relative_velocity[c]);
  out->status.push_back(StatusOf(tables.impulse[c], t.friction[c]));
}

}  // namespace

std::size_t StepOutcome::FirstNotFinite() const {
  std::size_t i = 0;
  while (i < bodies.size() && IsFinite(bodies.pose[i], bodies.velocity[i])) ++i;
  return i;
}

StepOutcome MoveBodies(const Population& population, const StepTables& tables, const Grid& grid, double rest, int rank) {
  StepOutcome outcome;
  AddBodies(population, tables, grid, rest, rank, &outcome.bodies);
  ContactResults& c = outcome.contacts;
  Reserve(tables.contacts.size(), &c.key, &c.gap, &c.final_gap, &c.normal, &c.point, &c.lever_a, &c.lever_b, &c.impulse,
          &c.relative_velocity, &c.status, &c.subdomain);
  for (std::size_t e = 0; e < tables.chosen.rows.size(); ++e) {
    for (const std::int32_t row : tables.chosen.rows[e]) AddContact(population, tables, grid, rest, row, &c);
    c.subdomain.resize(c.size(), tables.chosen.first + static_cast<std::int32_t>(e));
  }
  return outcome;
}

}  // namespace nscdd
