// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/time_stepper.h"

namespace nscdd::test {

/// One body of BodyResults.
struct BodyRow {
  std::int64_t id;
  BodyKind kind;
  Pose pose;
  Twist velocity;
  int multiplicity;
  int subdomain;
};

/// One contact of ContactResults.
struct ContactRow {
  ContactKey key;
  double gap, final_gap;
  Vec2 normal, point, impulse, relative_velocity;
  ContactStatus status;
};

inline std::vector<BodyRow> Rows(const BodyResults& b) {
  std::vector<BodyRow> rows;
  for (std::size_t i = 0; i < b.size(); ++i) {
    rows.push_back({b.id[i], b.kind[i], b.pose[i], b.velocity[i], b.multiplicity[i], b.subdomain[i]});
  }
  return rows;
}

inline std::vector<ContactRow> Rows(const ContactResults& c) {
  std::vector<ContactRow> rows;
  for (std::size_t i = 0; i < c.size(); ++i) {
    rows.push_back(
        {c.key[i], c.gap[i], c.final_gap[i], c.normal[i], c.point[i], c.impulse[i], c.relative_velocity[i], c.status[i]});
  }
  return rows;
}

}  // namespace nscdd::test
