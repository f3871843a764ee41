// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "nscdd/communicator.h"
#include "nscdd/reference/reference_adapter.h"
#include "nscdd/time_stepper.h"

namespace nscdd::test {

/// A small platform on one rank, as a user would have it: a world, its adapter and the solver. Fill `world`, then step; the
/// world may be edited between steps.
struct Host {
  explicit Host(const SteppingOptions& stepping_options = {}, const AlgorithmOptions& algorithm_options = NscdOptions{})
      : stepping(stepping_options), algorithm(algorithm_options) {}

  TimeStepper& stepper() {
    if (!adapter) adapter = std::make_unique<reference::ReferenceAdapter>(&world);
    if (!maker) maker.emplace(stepping, algorithm, adapter.get(), &communicator);
    return *maker;
  }
  const StepReport& Step(double dt) { return stepper().Step(dt); }
  const StepReport& Step(int count, double dt) {
    for (int k = 1; k < count; ++k) Step(dt);
    return Step(dt);
  }
  reference::Body& body(std::int64_t id) { return *world.Find(id); }

  /// The floor y = 0, half-plane number `id`.
  reference::Body& AddFloor(std::int64_t id, double friction = 0.0) {
    reference::Body floor = reference::MakeWall(id);
    floor.half_planes.push_back({});
    floor.friction = friction;
    return world.Add(floor);
  }
  reference::Body& AddDisk(std::int64_t id, Vec2 centre, double radius, double friction = 0.0) {
    reference::Body disk = reference::MakeDisk(id, centre, radius, 1000.0);
    disk.friction = friction;
    return world.Add(disk);
  }

  SteppingOptions stepping;
  AlgorithmOptions algorithm;
  reference::World world;
  SerialCommunicator communicator;
  std::unique_ptr<reference::ReferenceAdapter> adapter;
  std::optional<TimeStepper> maker;
};

/// NSCD that solves to rounding.
inline NscdOptions Exact() {
  NscdOptions o;
  o.stopping.tolerance = 1e-13;
  o.stopping.max_iterations = 100000;
  o.stopping.test_every = 1;
  return o;
}

}  // namespace nscdd::test
