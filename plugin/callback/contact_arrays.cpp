// SPDX-License-Identifier: Apache-2.0
#include "nscdd/callback/contact_arrays.h"

#include <fmt/format.h>

#include "array_copy.h"
#include "nscdd/error.h"

namespace nscdd {
namespace {

void CheckRows(const ContactTable& c, std::size_t body_count, const std::string& who) {
  const auto rows = static_cast<std::int64_t>(body_count);
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c.a[i] >= 0 && c.a[i] < rows && c.b[i] >= 0 && c.b[i] < rows) continue;
    throw Error(
        fmt::format("{}: contact {} joins the rows {} and {}, but there are {} bodies; count rows from 0 in the order given",
                    who, i, c.a[i], c.b[i], rows));
  }
}

}  // namespace

void CopyContacts(const nscdd_contacts& source, std::size_t body_count, ContactArrayNeeds needs, const std::string& who,
                  ContactTable* contacts) {
  const std::size_t count = CheckCount(source.count, "contacts", who);
  CopyColumn(source.a, "a", count, who, &contacts->a);
  CopyColumn(source.b, "b", count, who, &contacts->b);
  CopyColumn(source.gap, "gap", count, who, &contacts->gap);
  CopyPairs(source.normal, "normal", count, who, &contacts->normal);
  CopyColumn(source.lever_a, "lever_a", count, who, &contacts->lever_a);
  CopyColumn(source.lever_b, "lever_b", count, who, &contacts->lever_b);
  CopyColumn(source.flat, "flat", count, who, &contacts->flat);
  CopyColumn(source.friction, "friction", count, who, &contacts->friction);
  CopyColumn(source.restitution, "restitution", count, who, &contacts->restitution);
  if (needs.keys) {
    CopyColumn(source.shape_a, "shape_a", count, who, &contacts->shape_a);
    CopyColumn(source.shape_b, "shape_b", count, who, &contacts->shape_b);
  } else {
    contacts->shape_a.assign(count, 0);
    contacts->shape_b.assign(count, 0);
  }
  contacts->image.clear();
  if (needs.keys && source.image != nullptr) CopyColumn(source.image, "image", count, who, &contacts->image);
  contacts->site.assign(count, Vec2{});
  if (needs.sites || source.site != nullptr) CopyPairs(source.site, "site", count, who, &contacts->site);
  contacts->arm_a.clear();
  contacts->arm_b.clear();
  if (source.arm_a != nullptr || source.arm_b != nullptr) {
    CopyPairs(source.arm_a, "arm_a (arm_b is there; give both or none)", count, who, &contacts->arm_a);
    CopyPairs(source.arm_b, "arm_b (arm_a is there; give both or none)", count, who, &contacts->arm_b);
  }
  CheckRows(*contacts, body_count, who);
}

}  // namespace nscdd
