// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string_view>

#include "scene/scene.h"

namespace nscdd {

/// Tells the walls and clusters of a scene from its disks, by their ids.
class BodyRoles {
 public:
  explicit BodyRoles(const Scene& scene);

  /// "wall", "cluster", or nothing: a disk.
  std::string_view Of(std::int64_t id) const;

 private:
  void AddState(const StateBodies& bodies);

  FreeIds free_ids_;
  std::int64_t walls_ = 0;            ///< without an id of their own: the first free ids
  std::int64_t before_clusters_ = 0;  ///< bodies without an id before the first cluster; clusters are the last
  std::int64_t numbered_ = 0;         ///< bodies without an id
  std::set<std::int64_t> own_walls_, own_clusters_;
};

}  // namespace nscdd
