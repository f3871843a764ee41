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
