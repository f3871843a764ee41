// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/rank_group.h"
#include "results/result_tables.h"

namespace nscdd {

/// What the bodies of this rank look like in a saved state, in global axes.
struct PlacedShapes {
  GrainTable
      disks;        ///< a row for each disk of each body: that of the body, with the disk's centre, its velocity and its radius
  LineTable walls;  ///< segments, half-planes (as long as the sample), outlines of disks with prescribed motion
};

/// Collective. `grains` are the bodies that this rank owns now, `shapes` those of any bodies, in whatever way the ranks share
/// them. `mean_radius` [m] of the free bodies decides how fine outlines are.
PlacedShapes PlaceShapes(const GrainTable& grains, const ShapeTable& shapes, double mean_radius, const RankGroup& ranks);

/// The lines from the centre of A's disk to that of B's, of each contact; from or to the point on a side without disk.
LineTable ChainsOf(const ContactRows& contacts);

}  // namespace nscdd
