// SPDX-License-Identifier: Apache-2.0
#include "partition/domain_extent.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "nscdd/error.h"
#include "parallel/ordered_reduction.h"

namespace nscdd {

DomainExtent ReduceExtent(const BodyTable& bodies, const std::vector<Pose>& centre, const std::vector<double>& reach,
                          std::size_t newcomers, double dt, Communicator* communicator) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  struct Minima {
    double x, y, dt;
  } min{kInfinity, kInfinity, dt};
  struct Maxima {
    double x, y, dt, radius, reach, newcomers;
  } max{-kInfinity, -kInfinity, dt, 0.0, 0.0, static_cast<double>(newcomers)};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    max.radius = std::max(max.radius, bodies.radius[i]);
    max.reach = std::max(max.reach, reach[i]);
    if (bodies.kind[i] != BodyKind::kFree) continue;
    min.x = std::min(min.x, centre[i].x);
    min.y = std::min(min.y, centre[i].y);
    max.x = std::max(max.x, centre[i].x);
    max.y = std::max(max.y, centre[i].y);
  }
  // One call for all of it: boxes, radii, and what must be equal or known everywhere.
  ReduceExtremes(&min, &max, communicator);
  if (min.dt != max.dt)
    throw Error(fmt::format("the ranks have time steps from {} to {} s; give all the same", min.dt, max.dt));
  DomainExtent extent;
  if (min.x != kInfinity) {
    extent.low = {min.x, min.y};
    extent.high = {max.x, max.y};
  }
  extent.largest_radius = max.radius;
  extent.largest_reach = max.reach;
  extent.newcomers = max.newcomers > 0.0;
  return extent;
}

Grid GridOver(const DomainExtent& extent, const PartitionOptions& partition, const AdapterDescription& platform) {
  Grid grid(extent.low, extent.high, partition.nx, partition.ny);
  if (platform.period > 0.0) grid.SetPeriod(platform.period_origin, platform.period);
  return grid;
}

}  // namespace nscdd
