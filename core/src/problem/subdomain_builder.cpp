// SPDX-License-Identifier: Apache-2.0
#include "problem/subdomain_builder.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "nscdd/contact_kinematics.h"
#include "problem/contact_frame.h"

namespace nscdd {
namespace {

Vec2 ArmOf(const std::vector<Vec2>& arms, std::int32_t contact) { return arms.empty() ? Vec2{} : arms[contact]; }

}  // namespace

ContactModel RequiredModel(const ProblemTables& tables) {
  const ContactTable& contacts = *tables.contacts;
  bool arms = false;
  for (std::size_t c = 0; c < contacts.size() && contacts.has_arms() && !arms; ++c) {
    const Vec2 a = contacts.arm_a[c], b = contacts.arm_b[c];
    arms = (tables.inverse_mass[contacts.a[c]] > 0.0 && (a.x != 0.0 || a.y != 0.0)) ||
           (tables.inverse_mass[contacts.b[c]] > 0.0 && (b.x != 0.0 || b.y != 0.0));
  }
  const bool friction = std::any_of(contacts.friction.begin(), contacts.friction.end(), [](double mu) { return mu > 0.0; });
  return ModelWith(friction, arms);
}

SubdomainBuilder::SubdomainBuilder(const ProblemTables& tables, ContactModel model)
    : tables_(tables),
      model_(model),
      shared_(std::adjacent_find(tables.sharing->begin.begin(), tables.sharing->begin.end(),
                                 [](int a, int b) { return b - a > 1; }) != tables.sharing->begin.end()),
      scheduler_(tables.inverse_mass),
      copy_of_row_(tables.inverse_mass.size(), -1) {}

/// Row of the copy of `body`; `arm` leads from its centre of mass to the touching point.
std::int32_t SubdomainBuilder::CopyOf(std::int32_t body, Vec2 arm, SubdomainProblem* problem) {
  const Twist& v = tables_.free_velocity[body];
  const bool prescribed = tables_.inverse_mass[body] == 0.0;
  const bool own_copy = prescribed && v.spin != 0.0;
  // A prescribed body that turns moves every touching point otherwise: one copy per contact, without any spin.
  if (!own_copy && copy_of_row_[body] >= 0) return copy_of_row_[body];

  const auto copy = static_cast<std::int32_t>(problem->body.size());
  const int m = prescribed ? 1 : tables_.sharing->Multiplicity(body);
  problem->body.push_back(body);
  problem->inverse_mass.push_back(m * tables_.inverse_mass[body]);
  if (Inertias(model_) == 2) problem->inverse_mass.push_back(m * tables_.inverse_inertia[body]);
  const Vec2 touching = own_copy ? Vec2{v.vx - v.spin * arm.y, v.vy + v.spin * arm.x} : Linear(v);
  // + 0 turns -0 into 0, whose sign no sum with zero changes.
  problem->free_velocity.push_back(prescribed ? touching.x + 0.0 : touching.x);
  problem->free_velocity.push_back(prescribed ? touching.y + 0.0 : touching.y);
  if (Dofs(model_) == 3) problem->free_velocity.push_back(prescribed ? 0.0 : v.spin);
  if (shared_) problem->multiplicity.push_back(m);
  if (!own_copy) copy_of_row_[body] = copy;
  return copy;
}

template <class Row>
Row SubdomainBuilder::MakeRow(std::int32_t contact, SubdomainProblem* problem) {
  const ContactTable& table = *tables_.contacts;
  const ContactKinematics h = KinematicsOf(table, contact);
  Row row{};
  row.a = CopyOf(table.a[contact], ArmOf(table.arm_a, contact) + table.lever_a[contact] * h.n, problem);
  row.b = CopyOf(table.b[contact], ArmOf(table.arm_b, contact) - table.lever_b[contact] * h.n, problem);
  row.n = h.n;
  row.offset = tables_.offset[contact];
  if constexpr (HasArms(Row::kModel)) {
    row.turn_na = h.turn_na;
    row.turn_nb = h.turn_nb;
  }
  if constexpr (HasFriction(Row::kModel)) {
    row.turn_ta = h.turn_ta;
    row.turn_tb = h.turn_tb;
    row.friction = table.friction[contact];
  }
  constexpr int kInertias = Inertias(Row::kModel);
  // The law is solved with the divided masses; where W_nt = 0 the inverses are what a sweep needs.
  const Delassus w = DelassusBlock(row, &problem->inverse_mass[kInertias * row.a], &problem->inverse_mass[kInertias * row.b]);
  if constexpr (Row::kModel == ContactModel::kFrictionArms) {
    row.wnn = w.nn;
    row.wnt = w.nt;
    row.wtt = w.tt;
  } else {
    row.inverse_wnn = 1.0 / w.nn;
    if constexpr (HasFriction(Row::kModel)) row.inverse_wtt = 1.0 / w.tt;
  }
  return row;
}

SubdomainProblem SubdomainBuilder::Build(int subdomain, const std::vector<std::int32_t>& rows) {
  SubdomainProblem problem;
  problem.model = model_;
  problem.subdomain = subdomain;
  PacketOrder order = scheduler_.Order(rows, tables_.contacts->a, tables_.contacts->b);
  problem.contact = std::move(order.contact);
  problem.packet_begin = std::move(order.begin);
  VisitRows(problem, [&](auto& out) {
    using Row = typename std::decay_t<decltype(out)>::value_type;
    out.reserve(problem.contact.size());
    for (const std::int32_t contact : problem.contact) out.push_back(MakeRow<Row>(contact, &problem));
  });
  for (const std::int32_t body : problem.body) copy_of_row_[body] = -1;
  return problem;
}

}  // namespace nscdd
