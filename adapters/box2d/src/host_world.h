// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include "nscdd/vector.h"

namespace nscdd::box2d {

/// The b2World as a whole: gravity in double precision, and what its own collision detection costs us.
class HostWorld {
 public:
  HostWorld(b2World* world, double scale) : world_(world), scale_(scale) {}

  /// Throws Error inside a step or a callback of Box2D, where nothing may be changed.
  void CheckUnlocked() const;
  /// [m/s^2]; a gravity that the user sets in the world is adopted.
  Vec2 ReadGravity();
  void SetGravity(Vec2 gravity);

  /// Every fixture that leaves its box in the world's broad phase is noted there until the next b2World::Step, which never
  /// comes: that memory would grow for ever. `length` is the path of a body's shapes [Box2D units], `fixtures` their number.
  void AddPath(double length, int fixtures);
  /// Empties the notes when they may have become long, by a Step of zero time in which no pair may collide.
  void ForgetMovesIfMany();
  /// Marks all fixtures as moved, so that the next b2World::Step finds every pair.
  void RefreshContacts();

 private:
  b2World* world_;
  double scale_;
  Vec2 gravity_;
  b2Vec2 gravity_seen_ = {0.0f, 0.0f};
  double moves_ = 0.0;  // upper bound of the notes
};

}  // namespace nscdd::box2d
