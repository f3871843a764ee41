// SPDX-License-Identifier: Apache-2.0
#include "reference_host.h"

#include <vector>

namespace nscdd {

std::int64_t ReferenceHost::AddDisk(const conformance::DiskSpec& spec) {
  reference::Body body = reference::MakeDisk(spec.id, spec.centre, spec.radius, spec.density);
  body.kind = spec.kind;
  body.velocity = spec.velocity;
  body.friction = spec.friction;
  body.restitution = spec.restitution;
  return world_.Add(body).id;
}

std::optional<std::int64_t> ReferenceHost::AddCluster(const conformance::ClusterSpec& spec) {
  std::vector<reference::Disk> disks;
  for (const auto& member : spec.disks) disks.push_back({member.centre, member.radius});
  return world_.Add(reference::MakeCluster(spec.id, disks, spec.density)).id;
}

std::optional<std::int64_t> ReferenceHost::AddPolyline(const conformance::PolylineSpec& spec) {
  reference::Body wall = reference::MakeWall(spec.id);
  for (std::size_t i = 0; i + 1 < spec.points.size(); ++i) wall.segments.push_back({spec.points[i], spec.points[i + 1]});
  wall.friction = spec.friction;
  wall.restitution = spec.restitution;
  return world_.Add(wall).id;
}

std::optional<std::int64_t> ReferenceHost::AddHalfPlane(const conformance::HalfPlaneSpec& spec) {
  reference::Body wall = reference::MakeWall(spec.id, {spec.point.x, spec.point.y, 0.0});
  wall.half_planes = {{spec.normal, 0.0}};
  wall.friction = spec.friction;
  wall.restitution = spec.restitution;
  return world_.Add(wall).id;
}

bool ReferenceHost::NeverTouch(std::int64_t one, std::int64_t other) {
  world_.Find(one)->filter.group = world_.Find(other)->filter.group = -1;
  return true;
}

}  // namespace nscdd
