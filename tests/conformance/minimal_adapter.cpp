// SPDX-License-Identifier: Apache-2.0
#include "minimal_adapter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "nscdd/error.h"

namespace nscdd::minimal {
namespace {

/// A body at the pose that was asked for.
struct Placed {
  const Body* body;
  Vec2 centre;
};

void CheckPose(std::int64_t id, const Pose& q) {
  if (!std::isfinite(q.x + q.y + q.angle)) {
    throw Error(fmt::format("Body {} is sent to ({}, {}, {}): poses must be finite.", id, q.x, q.y, q.angle));
  }
}

std::vector<Placed> Place(const World& world, const PoseView& poses) {
  std::vector<Placed> placed;
  for (const auto& [id, body] : world.bodies) {
    const std::size_t row = placed.size();
    if (row >= poses.id.size() || poses.id[row] != id) {
      throw Error(fmt::format("Row {} should be the pose of body {}: name every body once, in ascending order.", row, id));
    }
    CheckPose(id, poses.pose[row]);
    placed.push_back({&body, Centre(poses.pose[row])});
  }
  if (placed.size() < poses.id.size()) {
    throw Error(fmt::format("There is a pose of body {}, but no such body.", poses.id[placed.size()]));
  }
  return placed;
}

/// The columns that all contacts have.
void Append(const std::vector<Placed>& placed, std::size_t a, std::size_t b, double gap, Vec2 normal, ContactTable* contacts) {
  const Body &body_a = *placed[a].body, &body_b = *placed[b].body;
  contacts->a.push_back(static_cast<std::int32_t>(a));
  contacts->b.push_back(static_cast<std::int32_t>(b));
  contacts->shape_a.push_back(0);  // every body has one shape
  contacts->shape_b.push_back(0);
  contacts->gap.push_back(gap);
  contacts->normal.push_back(normal);
  contacts->friction.push_back(std::sqrt(body_a.friction * body_b.friction));
  contacts->restitution.push_back(std::max(body_a.restitution, body_b.restitution));
}

void AppendDisks(const std::vector<Placed>& placed, std::size_t a, std::size_t b, double alert, ContactTable* contacts) {
  const double radius_a = placed[a].body->radius, radius_b = placed[b].body->radius;
  const Vec2 d = placed[b].centre - placed[a].centre;
  const double distance = Norm(d), gap = distance - radius_a - radius_b;
  if (gap > alert) return;
  Append(placed, a, b, gap, distance > 0.0 ? (1.0 / distance) * d : Vec2{0.0, 1.0}, contacts);
  contacts->lever_a.push_back(radius_a + 0.5 * gap);
  contacts->lever_b.push_back(radius_b + 0.5 * gap);
  contacts->arm_a.push_back({});
  contacts->arm_b.push_back({});
  contacts->site.push_back(0.5 * (placed[a].centre + placed[b].centre));
  contacts->flat.push_back(0);
}

void AppendDiskOnPlane(const std::vector<Placed>& placed, std::size_t a, std::size_t b, double alert, ContactTable* contacts) {
  const bool plane_is_a = placed[a].body->is_plane;
  const Placed &plane = placed[plane_is_a ? a : b], &disk = placed[plane_is_a ? b : a];
  const Vec2 n = plane.body->normal;
  const double height = Dot(n, disk.centre - plane.centre), gap = height - disk.body->radius;
  if (gap > alert) return;
  const Vec2 point = disk.centre - height * n, arm = point - plane.centre;
  Append(placed, a, b, gap, plane_is_a ? n : -1.0 * n, contacts);
  contacts->lever_a.push_back(plane_is_a ? 0.0 : height);
  contacts->lever_b.push_back(plane_is_a ? height : 0.0);
  contacts->arm_a.push_back(plane_is_a ? arm : Vec2{});
  contacts->arm_b.push_back(plane_is_a ? Vec2{} : arm);
  contacts->site.push_back(point);
  contacts->flat.push_back(1);
}

}  // namespace

void MinimalAdapter::ReadBodies(BodyTable* bodies) {
  bodies->Resize(world_->bodies.size());
  std::size_t row = 0;
  for (const auto& [id, body] : world_->bodies) {
    const double mass = std::numbers::pi * body.radius * body.radius * body.density;
    bodies->id[row] = id;
    bodies->kind[row] = body.is_fixed ? BodyKind::kPrescribed : BodyKind::kFree;
    bodies->mass[row] = mass;
    bodies->inertia[row] = 0.5 * mass * body.radius * body.radius;
    bodies->radius[row] = body.radius;
    bodies->bounding_radius[row] = body.is_plane ? std::numeric_limits<double>::infinity() : body.radius;
    bodies->pose[row] = body.pose;
    bodies->velocity[row] = body.velocity;
    bodies->force[row] = {mass * world_->gravity.x, mass * world_->gravity.y, 0.0};
    ++row;
  }
}

void MinimalAdapter::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  if (!(alert >= 0.0 && std::isfinite(alert))) throw Error(fmt::format("The alert distance {} is no length >= 0.", alert));
  const std::vector<Placed> placed = Place(*world_, poses);
  contacts->Clear();
  for (std::size_t a = 0; a < placed.size(); ++a) {  // rows ascend with ids: this order is that of the keys
    for (std::size_t b = a + 1; b < placed.size(); ++b) {
      if (placed[a].body->is_fixed && placed[b].body->is_fixed) continue;
      const bool has_plane = placed[a].body->is_plane || placed[b].body->is_plane;
      has_plane ? AppendDiskOnPlane(placed, a, b, alert, contacts) : AppendDisks(placed, a, b, alert, contacts);
    }
  }
}

void MinimalAdapter::Commit(const StepResult& result) {
  if (result.pose.size() != result.id.size() || result.velocity.size() != result.id.size()) {
    throw Error(fmt::format("Commit has {} ids, {} poses and {} velocities: give one of each for every body.", result.id.size(),
                            result.pose.size(), result.velocity.size()));
  }
  for (std::size_t i = 0; i < result.id.size(); ++i) {  // all checks first: a refused call changes nothing
    const Twist& v = result.velocity[i];
    if (!world_->bodies.contains(result.id[i]))
      throw Error(fmt::format("Commit names body {}, which is not there.", result.id[i]));
    CheckPose(result.id[i], result.pose[i]);
    if (!std::isfinite(v.vx + v.vy + v.spin))
      throw Error(fmt::format("Commit gives body {} no finite velocity.", result.id[i]));
  }
  for (std::size_t i = 0; i < result.id.size(); ++i) {
    Body& body = world_->bodies.at(result.id[i]);
    body.pose = result.pose[i];
    body.velocity = result.velocity[i];
  }
}

}  // namespace nscdd::minimal
