// SPDX-License-Identifier: Apache-2.0
// Which rank gets which body: without any rank.

#include <gtest/gtest.h>

#include "partition/halo_plan.h"

namespace nscdd {
namespace {

/// Unit disks at these places, ids from 10, all of rank 0 and nobody else's.
Population Disks(const std::vector<Vec2>& centres) {
  Population p;
  p.bodies.Resize(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    p.bodies.id[i] = 10 + static_cast<std::int64_t>(i);
    p.bodies.pose[i] = {centres[i].x, centres[i].y, 0.0};
    p.bodies.radius[i] = p.bodies.bounding_radius[i] = 1.0;
  }
  p.owner.assign(centres.size(), 0);
  p.holders.resize(centres.size());
  return p;
}

const Grid kTwoCells({0.0, 0.0}, {20.0, 10.0}, 2, 1);  // cut at x = 10
const Blocks kTwoRanks(2, 2);
const std::vector<double> kReaches(20, 0.05);
const Reach kReach{1.0, 0.05, kReaches};

HaloPlan Plan(const Population& p) { return MakeHaloPlan(p, p.bodies.pose, kTwoCells, kTwoRanks, kReach, 0); }

TEST(HaloPlan, ABodyFarFromTheCutStays) {
  const HaloPlan plan = Plan(Disks({{2.0, 5.0}}));
  EXPECT_TRUE(plan.sends.empty());
  EXPECT_TRUE(plan.removals.empty());
  EXPECT_TRUE(plan.leaving.empty());
  EXPECT_EQ(plan.owner, std::vector<int>{0});
  EXPECT_EQ(plan.holders, std::vector<std::vector<int>>{{0}});
}

TEST(HaloPlan, ABodyNearTheCutGetsAGhost) {
  const HaloPlan plan = Plan(Disks({{9.5, 5.0}}));
  ASSERT_EQ(plan.sends.size(), 1u);
  EXPECT_EQ(plan.sends[0].rank, 1);
  EXPECT_TRUE(plan.sends[0].with_shapes);
  EXPECT_TRUE(plan.leaving.empty());
  EXPECT_EQ(plan.migrated, 0);
  EXPECT_EQ(plan.holders, (std::vector<std::vector<int>>{{0, 1}}));
}

// The host that has the ghost is told the new numbers, but not the shapes again.
TEST(HaloPlan, AGhostThatStaysNeedsNoShapes) {
  Population p = Disks({{9.5, 5.0}});
  p.holders[0] = {0, 1};
  const HaloPlan plan = Plan(p);
  ASSERT_EQ(plan.sends.size(), 1u);
  EXPECT_FALSE(plan.sends[0].with_shapes);
}

TEST(HaloPlan, AGhostThatIsFarIsRemoved) {
  Population p = Disks({{2.0, 5.0}});
  p.holders[0] = {0, 1};
  const HaloPlan plan = Plan(p);
  EXPECT_TRUE(plan.sends.empty());
  ASSERT_EQ(plan.removals.size(), 1u);
  EXPECT_EQ(plan.removals[0].id, 10);
  EXPECT_EQ(plan.removals[0].rank, 1);
}

// Its new owner gets all that the old one knows, although it has had a ghost.
TEST(HaloPlan, ABodyThatCrossesTheCutChangesItsOwner) {
  Population p = Disks({{10.5, 5.0}, {18.0, 5.0}});
  p.holders[0] = {0, 1};
  const HaloPlan plan = Plan(p);
  ASSERT_EQ(plan.sends.size(), 2u);
  EXPECT_TRUE(plan.sends[0].with_shapes);
  EXPECT_TRUE(plan.sends[1].with_shapes);
  EXPECT_EQ(plan.owner, (std::vector<int>{1, 1}));
  EXPECT_EQ(plan.migrated, 2);
  EXPECT_EQ(plan.leaving, std::vector<std::int64_t>{11});  // the other one stays as a ghost
}

// The site of a disk and a large one is far from the small disk's centre.
TEST(HaloPlan, TheReachKnowsTheLargestDisk) {
  EXPECT_GE((Reach{1.0, 0.05, {}}.Of(1.0, 1.0, 0.05)), 1.1);
  EXPECT_GE((Reach{9.0, 0.05, {}}.Of(1.0, 1.0, 0.05)), 0.5 * (1.0 + 9.0 + 0.1));
  EXPECT_GE((Reach{9.0, 0.05, {}}.Of(1.0, 3.0, 0.05)), 3.0 + 0.5 * (9.0 + 0.1));  // a cluster's disks are away from its centre
}

}  // namespace
}  // namespace nscdd
