// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/reference/world.h"
#include "nscdd/report.h"
#include "nscdd/time_stepper.h"
#include "rows.h"

namespace nscdd::test {

/// A dense sample: a jittered triangular lattice of disks in an open box of segments (or over a row of fixed disks in a
/// periodic strip), gravity tilted. Deterministic.
struct Packing {
  int columns = 12;
  int rows = 10;
  double friction = 0.3;
  double restitution = 0.0;
  bool periodic = false;
  bool clusters = false;      ///< every fifth grain is a dumb-bell
  bool turning_wall = false;  ///< the floor is a wheel of disks that turns
  bool half_rough = false;    ///< grains of the upper half have no friction
  bool pegs = false;          ///< instead: every grain by itself on a fixed disk
  double tilt = 0.3;          ///< [rad]
};

std::vector<reference::Body> MakeBodies(const Packing& packing);

/// What a run left: bodies of all ranks by id, and the reports of its steps.
struct Outcome {
  std::vector<BodyRow> bodies;
  std::vector<StepReport> reports;
};

/// `steps` steps of 0.01 s. Rank r begins with body number k if k * ranks / count == r.
Outcome Run(const Packing& packing, const SteppingOptions& stepping, const AlgorithmOptions& algorithm, int steps,
            Communicator* communicator);

/// Empty if both agree bit for bit in everything but seconds and counts of messages; else what differs first.
std::string Difference(const Outcome& one, const Outcome& other);

}  // namespace nscdd::test
