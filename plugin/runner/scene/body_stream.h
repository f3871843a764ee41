// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string_view>

#include "scene/scene.h"

namespace nscdd {

/// Bodies of the scene, walls included.
std::int64_t CountBodies(const Scene& scene);

/// Do its bodies have no id of their own? They take free ones, in the order of the scene.
bool TakesFreeIds(const BodySource& source);

/// Calls `visit` for the bodies of this rank in the order of the scene: number k of n goes to rank floor(k ranks / n). Holds
/// one body at a time (and the surface of a deposition). Throws Error when a file that it names has changed since the scene was
/// read.
void ForEachBody(const Scene& scene, int rank, int ranks, const std::function<void(const BodyDefinition&)>& visit);

/// The ids that are left for bodies without one. Reads the tables that have ids; needs 16 bytes per body with an id of its own,
/// for the duration of the call. Throws Error, naming both places, if two bodies have the same.
FreeIds FindFreeIds(const Scene& scene);

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

/// Mean radius of the scene's free disks [m], members of clusters counted each; generated ones count with the middle of their
/// range. Every rank gets the same number.
double MeanGrainRadius(const Scene& scene);

}  // namespace nscdd
