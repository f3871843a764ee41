// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/vector.h"
#include "partition/grid.h"
#include "partition/population.h"

namespace nscdd {

/// How far from its centre a body may have contact sites at a detection.
struct Reach {
  double largest_radius = 0.0;  ///< [m] of any disk, on any rank
  double largest = 0.0;         ///< [m] reach of any body, on any rank: half the alert distance, or its motion in the step
  std::span<const double> own;  ///< [m] of each row

  double Of(double radius, double bounding_radius, double reach) const;
};

/// Where the bodies that a rank owns have to be in one step: each on the rank of its home cell, which then owns it, and as a
/// ghost on every rank that has a cell within its reach. Plain data, made without a word to other ranks.
struct HaloPlan {
  /// A body that another rank gets, or is told of anew.
  struct Send {
    std::int32_t row;
    int rank;
    bool with_shapes;  ///< its host does not have it, or has a ghost that the new owner replaces
  };
  /// A ghost that another rank need not hold any more.
  struct Removal {
    std::int64_t id;
    int rank;
  };

  std::vector<Send> sends;                ///< ascending by row
  std::vector<Removal> removals;          ///< ascending by id
  std::vector<std::int64_t> leaving;      ///< bodies that this rank need not hold any more, ascending
  std::vector<int> owner;                 ///< rank of each row's home cell
  std::vector<std::vector<int>> holders;  ///< ranks that need it, ascending, owner included
  std::int64_t migrated = 0;              ///< bodies that change their owner
};

/// For the rows of `population`, all owned by `rank`, whose centres are at `detection`.
HaloPlan MakeHaloPlan(const Population& population, const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks,
                      const Reach& reach, int rank);

}  // namespace nscdd
