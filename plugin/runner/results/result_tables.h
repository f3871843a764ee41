// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace nscdd {

/// Positions of the keys in ascending order.
template <class Key>
std::vector<std::size_t> AscendingOrder(const std::vector<Key>& keys) {
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}

/// Bodies that one rank owns, at the end of a step: one entry per body in every column.
struct GrainTable {
  std::vector<std::int64_t> id;
  std::vector<double> x;  ///< [m] centre of mass
  std::vector<double> y;
  std::vector<double> angle;  ///< [rad]
  std::vector<double> vx;     ///< [m/s]
  std::vector<double> vy;
  std::vector<double> spin;                ///< [rad/s]
  std::vector<double> radius;              ///< [m] of the largest disk; 0 if it has none
  std::vector<std::int32_t> multiplicity;  ///< subdomains that hold a contact of the body; 0: none
  std::vector<std::int32_t> subdomain;     ///< home cell of the centre
  std::vector<std::uint8_t> kind;          ///< 0 free, 1 prescribed motion (BodyKind)

  std::size_t size() const { return id.size(); }
};

/// Candidate contacts that one rank solved, at the end of a step: one entry per contact in every column.
/// Frames and signs: core/include/nscdd/contact_table.h.
struct ContactRows {
  std::vector<std::int64_t> body_a;
  std::vector<std::int64_t> body_b;
  std::vector<std::int32_t> shape_a;
  std::vector<std::int32_t> shape_b;
  std::vector<std::int32_t> image;
  std::vector<double> gap;        ///< [m] at the detection configuration
  std::vector<double> final_gap;  ///< [m] at the end of the step
  std::vector<double> normal_x;
  std::vector<double> normal_y;
  std::vector<double> point_x;  ///< [m] where the impulse acts
  std::vector<double> point_y;
  std::vector<double> lever_a;    ///< [m] A's disk has its centre at point - lever_a n, B's at point + lever_b n
  std::vector<double> lever_b;    ///< 0 for other shapes
  std::vector<double> impulse_n;  ///< [N s]
  std::vector<double> impulse_t;
  std::vector<double> force_n;  ///< [N] impulse / dt
  std::vector<double> force_t;
  std::vector<double> force_x;  ///< [N] the same in global axes, on B
  std::vector<double> force_y;
  std::vector<double> velocity_n;  ///< [m/s] relative, at the end of the step
  std::vector<double> velocity_t;
  std::vector<std::uint8_t> status;  ///< 0 open, 1 sticking, 2 sliding
  std::vector<std::int32_t> subdomain;

  std::size_t size() const { return body_a.size(); }
};

enum class ShapeKind : std::uint8_t {
  kDisk = 0,       ///< centre (x0, y0), radius
  kSegment = 1,    ///< from (x0, y0) to (x1, y1)
  kHalfPlane = 2,  ///< free side to the left of the direction (x1, y1) - (x0, y0), through (x0, y0)
};

/// What bodies look like, for pictures; in the body's frame (origin in the centre of mass, turned by its angle).
/// A body without an entry is drawn as one centred disk of GrainTable::radius.
struct ShapeTable {
  std::vector<std::int64_t> body;
  std::vector<ShapeKind> kind;
  std::vector<double> x0;  ///< [m]
  std::vector<double> y0;
  std::vector<double> x1;
  std::vector<double> y1;
  std::vector<double> radius;

  std::size_t size() const { return body.size(); }
};

/// Straight lines, for pictures.
struct LineTable {
  std::vector<double> x;  ///< [m] of points
  std::vector<double> y;
  std::vector<std::int32_t> ends;  ///< line i leads from point ends[2 i] to point ends[2 i + 1]
  std::vector<std::int64_t> body;  ///< whose shape line i is part of

  std::size_t size() const { return body.size(); }
};

/// What is constant in a run.
struct RunDescription {
  std::string scene;
  std::string solver;
  std::string version;  ///< of the program
  std::int64_t subdomains_x = 1;
  std::int64_t subdomains_y = 1;
  double period = 0.0;         ///< [m] length of the periodic direction x; 0: not periodic
  double period_origin = 0.0;  ///< [m] centres are kept in [period_origin, period_origin + period)
  double dt = 0.0;             ///< [s] time step
};

/// What is constant in a saved step.
struct StepDescription {
  std::int64_t step = 0;
  double time = 0.0;         ///< [s] step * dt, not the sum of dt's
  double mean_radius = 0.0;  ///< [m] of free bodies
};

inline constexpr std::int64_t kResultsFormatVersion = 2;

// The columns of each table: the only list of their names and units in results.h5, for writing and reading alike.
// `visit(name, unit, column)` is called for each in turn, `visit(name, unit, x, y)` for a vector, whose third component is 0 in
// the file: ParaView takes no shorter ones. Table is the struct of the function's name, const or not.

template <class Table, class Visit>
void ForEachGrainColumn(Table& table, Visit visit) {
  visit("id", "", table.id);
  visit("position", "m", table.x, table.y);
  visit("angle", "rad", table.angle);
  visit("velocity", "m/s", table.vx, table.vy);
  visit("spin", "rad/s", table.spin);
  visit("radius", "m", table.radius);
  visit("multiplicity", "", table.multiplicity);
  visit("subdomain", "", table.subdomain);
  visit("kind", "", table.kind);
}

template <class Table, class Visit>
void ForEachContactColumn(Table& table, Visit visit) {
  visit("body_a", "", table.body_a);
  visit("body_b", "", table.body_b);
  visit("shape_a", "", table.shape_a);
  visit("shape_b", "", table.shape_b);
  visit("image", "", table.image);
  visit("gap", "m", table.gap);
  visit("final_gap", "m", table.final_gap);
  visit("normal", "", table.normal_x, table.normal_y);
  visit("point", "m", table.point_x, table.point_y);
  visit("lever_a", "m", table.lever_a);
  visit("lever_b", "m", table.lever_b);
  visit("impulse_n", "N s", table.impulse_n);
  visit("impulse_t", "N s", table.impulse_t);
  visit("force_n", "N", table.force_n);
  visit("force_t", "N", table.force_t);
  visit("force", "N", table.force_x, table.force_y);
  visit("velocity_n", "m/s", table.velocity_n);
  visit("velocity_t", "m/s", table.velocity_t);
  visit("status", "", table.status);
  visit("subdomain", "", table.subdomain);
}

template <class Table, class Visit>
void ForEachShapeColumn(Table& table, Visit visit) {
  visit("body", "", table.body);
  visit("kind", "", table.kind);
  visit("x0", "m", table.x0);
  visit("y0", "m", table.y0);
  visit("x1", "m", table.x1);
  visit("y1", "m", table.y1);
  visit("radius", "m", table.radius);
}

/// The attributes of the root that describe the run.
template <class Run, class Visit>
void ForEachRunAttribute(Run& run, Visit visit) {
  visit("scene", run.scene);
  visit("solver", run.solver);
  visit("version", run.version);
  visit("subdomains_x", run.subdomains_x);
  visit("subdomains_y", run.subdomains_y);
  visit("dt", run.dt);
  visit("period", run.period);
  visit("period_origin", run.period_origin);
}

}  // namespace nscdd
