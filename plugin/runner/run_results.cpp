// SPDX-License-Identifier: Apache-2.0
#include "run_results.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace nscdd {
namespace {

template <class T>
void Copy(const TableView& table, const char* name, std::vector<T>* column) {
  if constexpr (std::is_same_v<T, double>) {
    const auto values = table.Real(name);
    column->assign(values.begin(), values.end());
  } else {
    for (const std::int64_t value : table.Integer(name)) column->push_back(static_cast<T>(value));
  }
}

}  // namespace

StepRow MakeStepRow(const StepReport& s) {
  const SolveReport& solve = s.solve;
  const Residuals& r = solve.residuals;
  StepRow row;
  row.step = s.step;
  row.time = s.time;
  row.contacts = solve.contacts;
  row.active = solve.active;
  row.iterations = solve.iterations;
  row.status = NameOf(solve.status);
  row.reason = solve.reason;
  row.nat = r.nat;
  row.nat_max = r.nat_max;
  row.qm16 = r.qm16;
  row.quad = r.quad;
  row.maxm = r.maxm;
  row.interface_jump = r.interface_jump;
  row.relative_jump = r.relative_jump;
  row.mean_interpenetration = s.mean_interpenetration;
  row.max_interpenetration = s.max_interpenetration;
  row.kinetic_energy = s.kinetic_energy;
  row.momentum_x = s.momentum_x;
  row.momentum_y = s.momentum_y;
  row.seconds_detect = s.seconds_detect;
  row.seconds_solve = s.seconds_solve;
  row.seconds_communicate = s.seconds_communicate;
  row.seconds_total = s.seconds_total;
  row.sweeps = solve.sweeps;
  row.sticking = solve.sticking;
  row.bodies = s.bodies;
  row.interface_bodies = solve.interface_bodies;
  row.interface_copies = solve.interface_copies;
  row.max_multiplicity = solve.max_multiplicity;
  row.empty_subdomains = solve.empty_subdomains;
  row.painleve_contacts = solve.painleve_contacts;
  row.interface_updates = solve.interface_updates;
  row.cg_iterations = solve.cg_iterations;
  row.cg_failures = solve.cg_failures;
  row.factorisations = solve.factorisations;
  row.seconds_interface = solve.seconds_interface;
  row.injected_energy = s.injected_energy;
  row.max_drift = s.max_drift;
  row.alert_distance = s.alert_distance;
  row.mean_radius = s.mean_radius;
  if (solve.contacts > 0) {
    row.worst_body_a = r.worst.body_a;
    row.worst_body_b = r.worst.body_b;
  }
  row.unknowns_per_contact = solve.unknowns_per_contact;
  row.unknowns_per_body = solve.unknowns_per_body;
  row.bytes_per_contact = solve.bytes_per_contact;
  row.bytes_per_body = solve.bytes_per_body;
  row.migrated_bodies = s.migrated_bodies;
  row.messages = s.messages;
  row.message_bytes = s.message_bytes;
  row.collectives = s.collectives;
  return row;
}

GrainTable MakeGrainTable(const Solver& solver) {
  const TableView t = solver.Table("bodies");
  GrainTable g;
  Copy(t, "id", &g.id);
  Copy(t, "x", &g.x);
  Copy(t, "y", &g.y);
  Copy(t, "angle", &g.angle);
  Copy(t, "vx", &g.vx);
  Copy(t, "vy", &g.vy);
  Copy(t, "spin", &g.spin);
  Copy(t, "radius", &g.radius);
  Copy(t, "multiplicity", &g.multiplicity);
  Copy(t, "subdomain", &g.subdomain);
  Copy(t, "kind", &g.kind);
  return g;
}

GrainTable MakeGrainTable(PlatformAdapter* adapter) {
  BodyTable bodies;
  adapter->ReadBodies(&bodies);
  GrainTable g;
  g.id = bodies.id;
  g.radius = bodies.radius;
  g.multiplicity.assign(bodies.size(), 0);
  g.subdomain.assign(bodies.size(), -1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    g.kind.push_back(static_cast<std::uint8_t>(bodies.kind[i]));
    g.x.push_back(bodies.pose[i].x);
    g.y.push_back(bodies.pose[i].y);
    g.angle.push_back(bodies.pose[i].angle);
    g.vx.push_back(bodies.velocity[i].vx);
    g.vy.push_back(bodies.velocity[i].vy);
    g.spin.push_back(bodies.velocity[i].spin);
  }
  return g;
}

double MeanRadius(const GrainTable& grains, const RankGroup& ranks) {
  double largest = 0.0;
  for (const double radius : grains.radius) largest = std::max(largest, radius);
  largest = -ranks.MinOfReals(-largest);
  if (!(largest > 0.0)) return 0.0;
  // Whole numbers have the same sum in any order, so on any number of ranks.
  constexpr double kUnits = 0x1p32;
  std::int64_t sum = 0, count = 0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (grains.kind[i] != 0) continue;
    sum += std::llround(grains.radius[i] / largest * kUnits);
    ++count;
  }
  sum = ranks.Sum(sum);
  count = ranks.Sum(count);
  return count == 0 ? 0.0 : largest * (static_cast<double>(sum) / kUnits / static_cast<double>(count));
}

ContactRows MakeContactRows(const Solver& solver, double dt) {
  const TableView t = solver.Table("contacts");
  ContactRows c;
  Copy(t, "body_a", &c.body_a);
  Copy(t, "body_b", &c.body_b);
  Copy(t, "shape_a", &c.shape_a);
  Copy(t, "shape_b", &c.shape_b);
  Copy(t, "image", &c.image);
  Copy(t, "gap", &c.gap);
  Copy(t, "final_gap", &c.final_gap);
  Copy(t, "normal_x", &c.normal_x);
  Copy(t, "normal_y", &c.normal_y);
  Copy(t, "point_x", &c.point_x);
  Copy(t, "point_y", &c.point_y);
  Copy(t, "lever_a", &c.lever_a);
  Copy(t, "lever_b", &c.lever_b);
  Copy(t, "impulse_n", &c.impulse_n);
  Copy(t, "impulse_t", &c.impulse_t);
  Copy(t, "velocity_n", &c.velocity_n);
  Copy(t, "velocity_t", &c.velocity_t);
  Copy(t, "status", &c.status);
  Copy(t, "subdomain", &c.subdomain);
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec2 force{c.impulse_n[i] / dt, c.impulse_t[i] / dt}, normal{c.normal_x[i], c.normal_y[i]};
    c.force_n.push_back(force.x);
    c.force_t.push_back(force.y);
    c.force_x.push_back(force.x * normal.x + force.y * normal.y);  // the tangent is (n_y, -n_x)
    c.force_y.push_back(force.x * normal.y - force.y * normal.x);
  }
  return c;
}

void AddShapes(const BodyDefinition& body, ShapeTable* shapes) {
  const auto add = [&](ShapeKind kind, Vec2 from, Vec2 to, double radius) {
    shapes->body.push_back(body.id);
    shapes->kind.push_back(kind);
    shapes->x0.push_back(from.x);
    shapes->y0.push_back(from.y);
    shapes->x1.push_back(to.x);
    shapes->y1.push_back(to.y);
    shapes->radius.push_back(radius);
  };
  const bool plain = body.disks.size() == 1 && body.segments.empty() && body.half_planes.empty() &&
                     body.disks[0].centre.x == 0.0 && body.disks[0].centre.y == 0.0;
  if (plain) return;
  for (const auto& disk : body.disks) add(ShapeKind::kDisk, disk.centre, {}, disk.radius);
  for (const auto& segment : body.segments) add(ShapeKind::kSegment, segment.a, segment.b, 0.0);
  for (const auto& plane : body.half_planes) {
    // The free side is to the left of the direction, so the normal is the direction turned by a quarter.
    const Vec2 through = plane.offset * plane.normal, direction{plane.normal.y, -plane.normal.x};
    add(ShapeKind::kHalfPlane, through, through + direction, 0.0);
  }
}

DeepContacts FindDeepContacts(const Solver& solver, double depth) {
  const TableView t = solver.Table("contacts");
  const auto gap = t.Real("gap");
  DeepContacts deep;
  for (std::size_t c = 0; c < gap.size(); ++c) {
    if (-gap[c] <= depth) continue;
    ++deep.count;
    if (-gap[c] <= deep.deepest) continue;
    deep.deepest = -gap[c];
    deep.body_a = t.Integer("body_a")[c];
    deep.body_b = t.Integer("body_b")[c];
  }
  return deep;
}

}  // namespace nscdd
