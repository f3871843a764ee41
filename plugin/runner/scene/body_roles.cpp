// SPDX-License-Identifier: Apache-2.0
#include "scene/body_roles.h"

#include "scene/body_stream.h"
#include "state/state_reader.h"

namespace nscdd {

BodyRoles::BodyRoles(const Scene& scene) : free_ids_(scene.free_ids) {
  for (const BodySource& source : scene.bodies) {
    const bool is_wall = std::holds_alternative<Wall>(source.what), is_cluster = std::holds_alternative<Cluster>(source.what);
    if (source.id && is_wall) own_walls_.insert(*source.id);
    if (source.id && is_cluster) own_clusters_.insert(*source.id);
    if (const auto* state = std::get_if<StateBodies>(&source.what)) AddState(*state);
    if (!TakesFreeIds(source)) continue;
    numbered_ += source.count;
    if (is_wall) walls_ += source.count;
    if (!is_cluster) before_clusters_ += source.count;
  }
}

void BodyRoles::AddState(const StateBodies& bodies) {
  const StateReader state(bodies.path);
  const std::vector<std::int64_t> ids = state.Ids();
  const std::vector<BodyRole> roles = state.Roles();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (roles[i] == BodyRole::kWall) own_walls_.insert(ids[i]);
    if (roles[i] == BodyRole::kCluster) own_clusters_.insert(ids[i]);
  }
}

std::string_view BodyRoles::Of(std::int64_t id) const {
  if (own_walls_.contains(id)) return "wall";
  if (own_clusters_.contains(id)) return "cluster";
  const std::optional<std::int64_t> number = free_ids_.NumberOf(id);
  if (!number || *number >= numbered_) return {};
  if (*number < walls_) return "wall";
  return *number < before_clusters_ ? std::string_view() : "cluster";
}

}  // namespace nscdd
