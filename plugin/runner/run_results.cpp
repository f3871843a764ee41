// SPDX-License-Identifier: Apache-2.0
#include "run_results.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace nscdd {
namespace {

/// Fills the columns that it is shown from those of the plugin's table; vectors from two of them.
struct ColumnCopier {
  const TableView& table;

  void operator()(const std::string& name, const char*, std::vector<double>& column) const {
    const auto values = table.Real(name);
    column.assign(values.begin(), values.end());
  }
  template <class T>
  void operator()(const std::string& name, const char*, std::vector<T>& column) const {
    for (const std::int64_t value : table.Integer(name)) column.push_back(static_cast<T>(value));
  }
  void operator()(const std::string& name, const char* unit, std::vector<double>& x, std::vector<double>& y) const {
    const std::string prefix = name == "position" ? "" : name == "velocity" ? "v" : name + "_";
    (*this)(prefix + "x", unit, x);
    (*this)(prefix + "y", unit, y);
  }
};

}  // namespace

GrainTable MakeGrainTable(const Solver& solver) {
  const TableView t = solver.Table("bodies");
  GrainTable g;
  ForEachGrainColumn(g, ColumnCopier{t});
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
  ForEachContactColumn(c, [copy = ColumnCopier{t}](const std::string& name, const char* unit, auto&... columns) {
    if (!name.starts_with("force")) copy(name, unit, columns...);  // they follow from the impulses
  });
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
  const TableView contacts = solver.Table("contacts");
  DeepContacts deep;
  for (const double gap : contacts.Real("gap")) {
    if (-gap <= depth) continue;
    ++deep.count;
    deep.deepest = std::max(deep.deepest, -gap);
  }
  return deep;
}

}  // namespace nscdd
