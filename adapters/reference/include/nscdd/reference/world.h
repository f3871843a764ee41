// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/vector.h"

namespace nscdd::reference {

/// A disk of a body. `centre` [m] is in the body's frame, from the centre of mass.
struct Disk {
  Vec2 centre;
  double radius = 0.0;  ///< [m] > 0
};

/// A wall from `a` to `b` [m], body frame: no thickness, touched from both sides, flat inside, a corner at each end.
struct Segment {
  Vec2 a;
  Vec2 b;
};

/// An infinite wall. In the body's frame the free side is  normal . x >= offset.
struct HalfPlane {
  Vec2 normal = {0.0, 1.0};  ///< unit, into the free side
  double offset = 0.0;       ///< [m]
};

/// Who may touch whom, as in Box2D: bodies of the same group != 0 touch if it is positive and do not if it is negative; any
/// other pair touches if each one's category is in the other's mask.
struct Filter {
  std::uint32_t category = 1;
  std::uint32_t mask = std::numeric_limits<std::uint32_t>::max();
  std::int32_t group = 0;
};

bool MayTouch(const Filter& one, const Filter& other);

/// A rigid body. Its shapes are numbered disks first, then segments, then half-planes, each in the order of its vector.
/// Free bodies have disks only (several: a cluster); prescribed ones may have any shapes.
struct Body {
  std::int64_t id = 0;  ///< >= 0
  BodyKind kind = BodyKind::kFree;
  double mass = 0.0;     ///< [kg] > 0 if free
  double inertia = 0.0;  ///< about the centre of mass [kg m^2] > 0 if free
  Pose pose;             ///< centre of mass and angle
  Twist velocity;
  Wrench force;  ///< besides gravity, until it is changed
  std::vector<Disk> disks;
  std::vector<Segment> segments;
  std::vector<HalfPlane> half_planes;
  double friction = 0.0;     ///< of a pair: sqrt(f1 f2)
  double restitution = 0.0;  ///< of a pair: the larger one
  Filter filter;
};

/// A free disk of `density` [kg/m^2] at rest.
Body MakeDisk(std::int64_t id, Vec2 centre, double radius, double density);
/// A free body at rest of disks given in the WORLD frame; mass and inertia are sums over the disks (overlaps count twice).
/// Throws Error without disks.
Body MakeCluster(std::int64_t id, std::span<const Disk> disks, double density);
/// A prescribed body without shapes yet, its frame at `pose`.
Body MakeWall(std::int64_t id, Pose pose = {});

/// Throws Error that names the body if a number of it is impossible.
void Validate(const Body& body);

/// Bodies behind pointers, as a range of references (clang 14 compiles no views of libstdc++).
template <class B>
class BodyRange {
 public:
  class Iterator {
   public:
    explicit Iterator(Body* const* at) : at_(at) {}
    B& operator*() const { return **at_; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    Body* const* at_;
  };

  BodyRange(std::span<Body* const> bodies) : bodies_(bodies) {}
  Iterator begin() const { return Iterator(bodies_.data()); }
  Iterator end() const { return Iterator(bodies_.data() + bodies_.size()); }
  std::size_t size() const { return bodies_.size(); }
  B& operator[](std::size_t i) const { return *bodies_[i]; }

 private:
  std::span<Body* const> bodies_;
};

/// The bodies of a small platform that integrates nothing by itself: it is moved by the solver, or by its user.
class World {
 public:
  Vec2 gravity;                ///< [m/s^2], acts on free bodies
  double period = 0.0;         ///< [m] length of the periodic direction x; 0: not periodic
  double period_origin = 0.0;  ///< [m] where the period begins

  World() = default;
  World(World&&) = default;  // bodies stay where they are in memory
  World& operator=(World&&) = default;

  /// Takes over a valid body with a new id; the reference holds until Remove(). Throws Error otherwise.
  Body& Add(Body body);
  /// Throws Error if the body is not there.
  void Remove(std::int64_t id);
  /// Null if the body is not there. The user may edit what it points to, but neither `id` nor the number of shapes.
  Body* Find(std::int64_t id);
  const Body* Find(std::int64_t id) const;

  std::size_t size() const { return bodies_.size(); }
  /// A range of Body in ascending order of id, valid until the next Add() or Remove().
  BodyRange<Body> bodies() { return {InOrder()}; }
  BodyRange<const Body> bodies() const { return {InOrder()}; }

 private:
  std::span<Body* const> InOrder() const;

  std::map<std::int64_t, Body> bodies_;
  mutable std::vector<Body*> in_order_;  // quicker to walk than the map; empty after Add() and Remove()
};

}  // namespace nscdd::reference
