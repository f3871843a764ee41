// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/result_tables.h"

namespace nscdd {

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

}  // namespace nscdd
