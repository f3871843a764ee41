// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "body_store.h"

namespace nscdd::box2d {

/// Who may touch whom: categories, masks and groups, the user's b2ContactFilter, and joints with collideConnected = false.
class PairFilter {
 public:
  /// Reads joints and contact filter. Throws Error on a joint that would have to be solved, unless `joints_only_filter`.
  void Read(b2World* world, const BodyStore& store, bool joints_only_filter);

  bool Allows(const Shape& a, const Shape& b) const {
    if (users_ != nullptr || !jointed_.empty()) return AsksUser(a, b);
    return AllowsByBits(a, b);
  }

 private:
  static bool AllowsByBits(const Shape& a, const Shape& b) {
    if (a.group == b.group && a.group != 0) return a.group > 0;
    return (a.mask & b.category) != 0 && (a.category & b.mask) != 0;
  }
  bool AsksUser(const Shape& a, const Shape& b) const;

  b2ContactFilter* users_ = nullptr;                            // null: Box2D's default
  std::vector<std::pair<std::int32_t, std::int32_t>> jointed_;  // slots, smaller first; sorted
};

}  // namespace nscdd::box2d
