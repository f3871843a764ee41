// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include "nscdd/body_table.h"
#include "nscdd/contact_table.h"
#include "nscdd/vector.h"
#include "nscdd_plugin.h"

namespace nscdd {

// Columns of vectors cross the C interface without a copy because they are consecutive doubles.
static_assert(sizeof(Vec2) == 2 * sizeof(double) && std::is_standard_layout_v<Vec2> && std::is_trivially_copyable_v<Vec2>);
static_assert(sizeof(Pose) == 3 * sizeof(double) && std::is_standard_layout_v<Pose> && std::is_trivially_copyable_v<Pose>);
static_assert(sizeof(Twist) == 3 * sizeof(double) && std::is_standard_layout_v<Twist> && std::is_trivially_copyable_v<Twist>);
static_assert(sizeof(Wrench) == 3 * sizeof(double) && std::is_standard_layout_v<Wrench> &&
              std::is_trivially_copyable_v<Wrench>);
static_assert(sizeof(BodyKind) == sizeof(std::uint8_t));

template <class T>
const double* AsDoubles(const T* first) {
  static_assert(sizeof(T) % sizeof(double) == 0 && std::is_standard_layout_v<T>);
  return reinterpret_cast<const double*>(first);
}

template <class T>
double* AsDoubles(T* first) {
  static_assert(sizeof(T) % sizeof(double) == 0 && std::is_standard_layout_v<T>);
  return reinterpret_cast<double*>(first);
}

/// Plugins of every minor take the structures that have not grown since minor 0; whoever fills what is newer says so.
template <class Structure>
Structure WithHeader() {
  Structure structure{};
  structure.header = {sizeof(Structure), NSCDD_ABI_MAJOR, 0};
  return structure;
}

/// Shows a table's columns; valid as long as the table is unchanged.
inline nscdd_contacts ShowContacts(const ContactTable& table) {
  nscdd_contacts c{};
  c.count = table.size();
  c.a = table.a.data();
  c.b = table.b.data();
  c.shape_a = table.shape_a.data();
  c.shape_b = table.shape_b.data();
  c.image = table.has_images() ? table.image.data() : nullptr;
  c.gap = table.gap.data();
  c.normal = AsDoubles(table.normal.data());
  c.lever_a = table.lever_a.data();
  c.lever_b = table.lever_b.data();
  c.arm_a = table.has_arms() ? AsDoubles(table.arm_a.data()) : nullptr;
  c.arm_b = table.has_arms() ? AsDoubles(table.arm_b.data()) : nullptr;
  c.site = AsDoubles(table.site.data());
  c.flat = table.flat.data();
  c.friction = table.friction.data();
  c.restitution = table.restitution.data();
  return c;
}

}  // namespace nscdd
