// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "nscdd/contact_table.h"

namespace nscdd::conformance {

/// Calls apply(column) for each column that is in use.
template <typename Apply>
void ForEachColumn(ContactTable* contacts, Apply apply) {
  apply(&contacts->a);
  apply(&contacts->b);
  apply(&contacts->shape_a);
  apply(&contacts->shape_b);
  if (contacts->has_images()) apply(&contacts->image);
  apply(&contacts->gap);
  apply(&contacts->normal);
  apply(&contacts->lever_a);
  apply(&contacts->lever_b);
  if (contacts->has_arms()) {
    apply(&contacts->arm_a);
    apply(&contacts->arm_b);
  }
  apply(&contacts->site);
  apply(&contacts->flat);
  if (contacts->has_moments()) apply(&contacts->moment);
  apply(&contacts->friction);
  apply(&contacts->restitution);
}

inline void EraseContact(std::size_t i, ContactTable* contacts) {
  ForEachColumn(contacts, [i](auto* column) { column->erase(column->begin() + static_cast<std::ptrdiff_t>(i)); });
}

inline void SwapContacts(std::size_t i, std::size_t j, ContactTable* contacts) {
  ForEachColumn(contacts, [i, j](auto* column) { std::swap((*column)[i], (*column)[j]); });
}

inline void RepeatLastContact(ContactTable* contacts) {
  ForEachColumn(contacts, [](auto* column) { column->push_back(column->back()); });
}

inline ContactKey KeyOf(const ContactTable& contacts, std::span<const std::int64_t> id, std::size_t i) {
  return {id[static_cast<std::size_t>(contacts.a[i])], id[static_cast<std::size_t>(contacts.b[i])], contacts.shape_a[i],
          contacts.shape_b[i], contacts.has_images() ? contacts.image[i] : 0};
}

inline Vec2 ArmA(const ContactTable& contacts, std::size_t i) { return contacts.has_arms() ? contacts.arm_a[i] : Vec2{}; }
inline Vec2 ArmB(const ContactTable& contacts, std::size_t i) { return contacts.has_arms() ? contacts.arm_b[i] : Vec2{}; }

}  // namespace nscdd::conformance
