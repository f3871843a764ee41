// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nscdd/vector.h"

namespace nscdd {

enum class BodyKind : std::uint8_t {
  kFree = 0,        ///< moves under loads and contacts
  kPrescribed = 1,  ///< keeps the velocity that the platform gives it (zero: a fixed wall); its inverse mass is zero
};

/// The bodies that a platform holds, as a structure of arrays with one entry per body.
///
/// A rank's table holds the bodies of its subdomains and their ghosts, never the whole world. All columns have size().
struct BodyTable {
  std::vector<std::int64_t> id;  ///< unique, stable as long as the body lives; any non-negative number
  std::vector<BodyKind> kind;
  std::vector<double> mass;             ///< [kg], finite and > 0 if kFree, not read if kPrescribed
  std::vector<double> inertia;          ///< about the centre of mass [kg m^2], finite and > 0 if kFree, else not read
  std::vector<double> radius;           ///< [m] radius of the largest disk of the body; 0 if it has none (a wall of segments)
  std::vector<double> bounding_radius;  ///< [m] of a circle about the centre that holds every shape; +inf for half-planes
  std::vector<Pose> pose;               ///< centre of mass and angle at the beginning of the step
  std::vector<Twist> velocity;          ///< at the beginning of the step; of a prescribed body: during the step
  std::vector<Wrench> force;            ///< external load during the step, gravity included; not read if kPrescribed

  std::size_t size() const { return id.size(); }

  void Resize(std::size_t count) {
    id.resize(count);
    kind.resize(count, BodyKind::kFree);
    mass.resize(count);
    inertia.resize(count);
    radius.resize(count);
    bounding_radius.resize(count);
    pose.resize(count);
    velocity.resize(count);
    force.resize(count);
  }
};

}  // namespace nscdd
