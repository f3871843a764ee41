// SPDX-License-Identifier: Apache-2.0
#include "nscdd/reference/world.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "nscdd/error.h"

namespace nscdd::reference {
namespace {

bool Finite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

[[noreturn]] void Refuse(const Body& body, const std::string& what) {
  throw Error(fmt::format("Body {} of the reference world {}.", body.id, what));
}

void ValidateShapes(const Body& body) {
  for (std::size_t i = 0; i < body.disks.size(); ++i) {
    const Disk& disk = body.disks[i];
    if (!(disk.radius > 0.0 && std::isfinite(disk.radius) && Finite(disk.centre))) {
      Refuse(body, fmt::format("has disk {} of radius {} at ({}, {}): give a finite centre and a finite radius > 0 in metres",
                               i, disk.radius, disk.centre.x, disk.centre.y));
    }
  }
  for (std::size_t i = 0; i < body.segments.size(); ++i) {
    const Segment& s = body.segments[i];
    if (!Finite(s.a) || !Finite(s.b) || !(Norm(s.b - s.a) > 0.0)) {
      Refuse(body, fmt::format("has segment {} from ({}, {}) to ({}, {}): give two different finite points", i, s.a.x, s.a.y,
                               s.b.x, s.b.y));
    }
  }
  for (std::size_t i = 0; i < body.half_planes.size(); ++i) {
    const HalfPlane& plane = body.half_planes[i];
    if (!(std::abs(Norm(plane.normal) - 1.0) <= 1e-12) || !std::isfinite(plane.offset)) {
      Refuse(body, fmt::format("has half-plane {} with normal ({}, {}) and offset {}: give a unit normal and a finite offset",
                               i, plane.normal.x, plane.normal.y, plane.offset));
    }
  }
}

void ValidateFreeBody(const Body& body) {
  if (!(body.mass > 0.0 && std::isfinite(body.mass))) {
    Refuse(body, fmt::format("is free and has mass {} kg: give a finite mass > 0, or make it prescribed", body.mass));
  }
  if (!(body.inertia > 0.0 && std::isfinite(body.inertia))) {
    Refuse(body,
           fmt::format("is free and has inertia {} kg m^2: give a finite inertia > 0, or make it prescribed", body.inertia));
  }
  if (!body.segments.empty() || !body.half_planes.empty()) {
    Refuse(body, "is free and has segments or half-planes: build it from disks, or make it prescribed");
  }
  if (body.disks.empty()) Refuse(body, "is free and has no disk: give it at least one");
}

}  // namespace

bool MayTouch(const Filter& one, const Filter& other) {
  if (one.group != 0 && one.group == other.group) return one.group > 0;
  return (one.category & other.mask) != 0 && (other.category & one.mask) != 0;
}

void Validate(const Body& body) {
  if (body.id < 0) Refuse(body, "has a negative id: number bodies from 0");
  const Pose& q = body.pose;
  if (!std::isfinite(q.x + q.y + q.angle)) {
    Refuse(body, fmt::format("is at ({}, {}) with angle {}: give finite numbers", q.x, q.y, q.angle));
  }
  const Twist& v = body.velocity;
  if (!std::isfinite(v.vx + v.vy + v.spin)) {
    Refuse(body, fmt::format("has velocity ({}, {}) and spin {}: give finite numbers", v.vx, v.vy, v.spin));
  }
  const Wrench& f = body.force;
  if (!std::isfinite(f.fx + f.fy + f.torque)) {
    Refuse(body, fmt::format("has force ({}, {}) and torque {}: give finite numbers", f.fx, f.fy, f.torque));
  }
  if (!(body.friction >= 0.0 && std::isfinite(body.friction))) {
    Refuse(body, fmt::format("has friction {}: give a finite number >= 0", body.friction));
  }
  if (!(body.restitution >= 0.0 && body.restitution <= 1.0)) {
    Refuse(body, fmt::format("has restitution {}: give a number in [0, 1]", body.restitution));
  }
  if (body.kind == BodyKind::kFree) ValidateFreeBody(body);
  ValidateShapes(body);
}

Body MakeDisk(std::int64_t id, Vec2 centre, double radius, double density) {
  const Disk disk{centre, radius};
  return MakeCluster(id, {&disk, 1}, density);
}

Body MakeCluster(std::int64_t id, std::span<const Disk> disks, double density) {
  if (disks.empty()) throw Error(fmt::format("Cluster {} has no disks: give it at least one.", id));
  Body body;
  body.id = id;
  Vec2 moment;
  for (const Disk& disk : disks) {
    const double mass = density * std::numbers::pi * disk.radius * disk.radius;
    body.mass += mass;
    moment = moment + mass * disk.centre;
  }
  // The centre of one disk is taken as it is: moment / mass would round it.
  const Vec2 centre = disks.size() == 1 ? disks[0].centre : (1.0 / body.mass) * moment;
  for (const Disk& disk : disks) {
    const double mass = density * std::numbers::pi * disk.radius * disk.radius;
    const Vec2 arm = disk.centre - centre;
    body.inertia += mass * (0.5 * disk.radius * disk.radius + Dot(arm, arm));
    body.disks.push_back({arm, disk.radius});
  }
  body.pose = {centre.x, centre.y, 0.0};
  return body;
}

Body MakeWall(std::int64_t id, Pose pose) {
  Body body;
  body.id = id;
  body.kind = BodyKind::kPrescribed;
  body.pose = pose;
  return body;
}

Body& World::Add(Body body) {
  Validate(body);
  const auto id = body.id;
  const auto [position, added] = bodies_.try_emplace(id, std::move(body));
  if (!added) throw Error(fmt::format("Body {} is in the reference world already: ids are unique.", id));
  in_order_.clear();
  return position->second;
}

void World::Remove(std::int64_t id) {
  in_order_.clear();
  if (bodies_.erase(id) == 0) throw Error(fmt::format("Body {} cannot be removed: the reference world does not hold it.", id));
}

Body* World::Find(std::int64_t id) {
  const auto position = bodies_.find(id);
  return position == bodies_.end() ? nullptr : &position->second;
}

const Body* World::Find(std::int64_t id) const {
  const auto position = bodies_.find(id);
  return position == bodies_.end() ? nullptr : &position->second;
}

std::span<Body* const> World::InOrder() const {
  if (in_order_.size() != bodies_.size()) {
    in_order_.clear();
    // The pointers are handed out as const by the const overload of bodies() only.
    for (auto& [id, body] : const_cast<World*>(this)->bodies_) in_order_.push_back(&body);
  }
  return in_order_;
}

}  // namespace nscdd::reference
