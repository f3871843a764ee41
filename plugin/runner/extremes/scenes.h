// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/reference/world.h"
#include "nscdd/vector.h"

namespace nscdd {

inline constexpr double kGravity = 9.81;  ///< [m/s^2] of all cases that have gravity

/// The half-plane y >= height as body `id`.
void AddFloor(reference::World* world, std::int64_t id, double height = 0.0, double friction = 0.0);

/// Returns the disk, to be edited.
reference::Body& AddGrain(reference::World* world, std::int64_t id, Vec2 centre, double radius, double friction = 0.0,
                          double density = 1000.0);

struct Grain {
  double radius = 0.5;      ///< [m]
  double density = 1000.0;  ///< [kg/m^2]
};

/// A floor (body 0) and touching disks (bodies 1, 2, ...) one above the other, under gravity: at rest for ever.
void BuildStack(const std::vector<Grain>& grains, double friction, Vec2 origin, reference::World* world);

/// Rows of touching disks between a floor and two walls (segments of body 0), under gravity: at rest for ever.
struct Pile {
  int columns = 6;  ///< of the even rows; the odd ones lie in their hollows
  int rows = 5;
  double radius = 0.5;            ///< [m]
  double friction = 0.0;          ///< of the walls and of every other grain
  double other_friction = -1.0;   ///< of the remaining grains; negative: the same
  double spacing = 1.0;           ///< below 1 the grains overlap
  bool right_wall = true;         ///< without it the pile begins to flow
  Vec2 origin = {};               ///< [m] lower left corner
  double largest_velocity = 0.0;  ///< [m/s] of random first velocities
};
void BuildPile(const Pile& pile, reference::World* world);

}  // namespace nscdd
