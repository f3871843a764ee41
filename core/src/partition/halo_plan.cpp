// SPDX-License-Identifier: Apache-2.0
#include "partition/halo_plan.h"

#include <algorithm>
#include <utility>

namespace nscdd {
namespace {

bool Contains(const std::vector<int>& ranks, int rank) { return std::binary_search(ranks.begin(), ranks.end(), rank); }

/// The owner and every rank with a cell within `reach` of the centre, ascending.
std::vector<int> RanksNear(Vec2 centre, double reach, int owner, const Grid& grid, const Blocks& blocks) {
  std::vector<int> ranks{owner};
  grid.ForEachCellNear(centre, reach, [&](int cell) {
    const int rank = blocks.RankOf(cell);
    if (ranks.back() != rank) ranks.push_back(rank);
  });
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

}  // namespace

// The site of two disks is the mid-point of their centres: (rho_i + rho_j + reach_i + reach_j) / 2 from a disk's centre at
// most; that of a disk and another wall is on the wall, rho_i + both reaches from it. A disk's centre is within bounding_radius
// of the centre of mass.
double Reach::Of(double radius, double bounding_radius, double reach) const {
  const double alert = reach + largest;
  const double half = 0.5 * (largest_radius + alert);
  const double exact =
      bounding_radius == radius ? std::max(radius + alert, 0.5 * radius + half) : bounding_radius + std::max(alert, half);
  return exact * (1.0 + 1e-6);  // rounding of sites and gaps
}

HaloPlan MakeHaloPlan(const Population& population, const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks,
                      const Reach& reach, int rank) {
  HaloPlan plan;
  const BodyTable& t = population.bodies;
  plan.owner.reserve(t.size());
  plan.holders.reserve(t.size());
  for (std::size_t row = 0; row < t.size(); ++row) {
    const Vec2 centre = Centre(detection[row]);
    const int home = blocks.RankOf(grid.CellOf(centre));
    std::vector<int> needed =
        RanksNear(centre, reach.Of(t.radius[row], t.bounding_radius[row], reach.own[row]), home, grid, blocks);
    const std::vector<int>& before = population.holders[row];
    for (const int other : needed) {
      if (other == rank) continue;
      // A new owner's host takes over all that the old one knows (loads, the user's edits), so its ghost is replaced.
      plan.sends.push_back({static_cast<std::int32_t>(row), other, !Contains(before, other) || other == home});
    }
    for (const int other : before) {
      if (other != rank && !Contains(needed, other)) plan.removals.push_back({t.id[row], other});
    }
    if (!Contains(needed, rank)) plan.leaving.push_back(t.id[row]);
    plan.migrated += home != rank;
    plan.owner.push_back(home);
    plan.holders.push_back(std::move(needed));
  }
  return plan;
}

}  // namespace nscdd
