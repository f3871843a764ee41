// SPDX-License-Identifier: Apache-2.0
#include "body_arrays.h"

#include <fmt/format.h>

#include <algorithm>

#include "array_copy.h"

namespace nscdd {
namespace {

[[noreturn]] void Refuse(const std::string& who, std::int64_t id, const std::string& what) {
  throw Error(fmt::format("{}: body {}: {}", who, id, what));
}

void CheckIds(std::vector<std::int64_t> id, const std::string& who) {
  if (!std::is_sorted(id.begin(), id.end())) std::sort(id.begin(), id.end());
  if (!id.empty() && id.front() < 0) Refuse(who, id.front(), "ids must be >= 0");
  const auto twice = std::adjacent_find(id.begin(), id.end());
  if (twice != id.end()) Refuse(who, *twice, "the id is given twice; ids must be unique");
}

void CheckKinds(const nscdd_bodies& source, const std::string& who) {
  for (std::size_t i = 0; i < source.count; ++i) {
    if (source.kind[i] > 1) {
      Refuse(who, source.id[i], fmt::format("kind is {}, must be 0 (free) or 1 (prescribed motion)", source.kind[i]));
    }
  }
}

}  // namespace

void CopyBodies(const nscdd_bodies& source, const std::string& who, BodyTable* bodies) {
  static_assert(sizeof(BodyKind) == sizeof(std::uint8_t));
  const std::size_t count = CheckCount(source.count, "bodies", who);
  CopyElements(source.id, "id", count, who, &bodies->id);
  CopyElements(source.kind, "kind", count, who, &bodies->kind);
  CheckKinds(source, who);
  CopyElements(source.mass, "mass", count, who, &bodies->mass);
  CopyElements(source.inertia, "inertia", count, who, &bodies->inertia);
  CopyElements(source.radius, "radius", count, who, &bodies->radius);
  CopyElements(source.bounding_radius, "bounding_radius", count, who, &bodies->bounding_radius);
  CopyElements(source.pose, "pose", count, who, &bodies->pose);
  CopyElements(source.velocity, "velocity", count, who, &bodies->velocity);
  CopyElements(source.force, "force", count, who, &bodies->force);
  CheckIds(bodies->id, who);
}

}  // namespace nscdd
