// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace nscdd {

/// Bodies of a state file as columns; their shapes are rows of the tables below, from `first_...` to that of the next body.
struct StateBodyTable {
  std::vector<std::int64_t> id;
  std::vector<std::uint8_t> kind;  ///< 0 free, 1 prescribed motion (BodyKind)
  std::vector<BodyRole> role;
  std::vector<std::int32_t> material;  ///< number in /materials
  std::vector<double> mass, inertia, x, y, angle, vx, vy, spin;
  std::vector<std::int64_t> first_disk, first_segment, first_half_plane;

  std::size_t size() const { return id.size(); }
};

/// Shapes, in the frame of their body.
struct StateShapeTables {
  std::vector<double> disk_x, disk_y, disk_radius;
  std::vector<double> segment_x0, segment_y0, segment_x1, segment_y1;
  std::vector<double> plane_normal_x, plane_normal_y, plane_offset;
};

// Calls visit(name, unit, column) for each column of a table.

template <class Table, class Visit>
void ForEachStateBodyColumn(Table& t, Visit&& visit) {
  visit("id", "", t.id);
  visit("kind", "", t.kind);
  visit("role", "", t.role);
  visit("material", "", t.material);
  visit("mass", "kg", t.mass);
  visit("inertia", "kg m^2", t.inertia);
  visit("x", "m", t.x);
  visit("y", "m", t.y);
  visit("angle", "rad", t.angle);
  visit("vx", "m/s", t.vx);
  visit("vy", "m/s", t.vy);
  visit("spin", "rad/s", t.spin);
  visit("first_disk", "", t.first_disk);
  visit("first_segment", "", t.first_segment);
  visit("first_half_plane", "", t.first_half_plane);
}

template <class Table, class Visit>
void ForEachStateDiskColumn(Table& t, Visit&& visit) {
  visit("x", "m", t.disk_x);
  visit("y", "m", t.disk_y);
  visit("radius", "m", t.disk_radius);
}

template <class Table, class Visit>
void ForEachStateSegmentColumn(Table& t, Visit&& visit) {
  visit("x0", "m", t.segment_x0);
  visit("y0", "m", t.segment_y0);
  visit("x1", "m", t.segment_x1);
  visit("y1", "m", t.segment_y1);
}

template <class Table, class Visit>
void ForEachStatePlaneColumn(Table& t, Visit&& visit) {
  visit("normal_x", "", t.plane_normal_x);
  visit("normal_y", "", t.plane_normal_y);
  visit("offset", "m", t.plane_offset);
}

/// The attributes of a state file's root.
template <class Head, class Visit>
void ForEachStateAttribute(Head& head, Visit&& visit) {
  visit("version", head.program);
  visit("plugin", head.plugin);
  visit("scene", head.scene);
  visit("step", head.clock.step);
  visit("time", head.clock.time);
  visit("even_since", head.clock.even_since);
  visit("even_time", head.clock.even_time);
  visit("dt", head.dt);
  visit("period", head.period);
  visit("period_origin", head.period_origin);
  visit("mean_radius", head.mean_radius);
}

/// And those of a material's group.
template <class Material, class Visit>
void ForEachMaterialAttribute(Material& material, Visit&& visit) {
  visit("name", material.name);
  visit("density", material.density);
  visit("friction", material.friction);
  visit("restitution", material.restitution);
}

}  // namespace nscdd
