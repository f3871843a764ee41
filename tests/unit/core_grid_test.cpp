// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "partition/grid.h"

namespace nscdd {
namespace {

TEST(Grid, PointOnACutGoesToTheUpperCell) {
  const Grid grid({0, 0}, {4, 2}, 2, 2);
  EXPECT_EQ(grid.CellOf({1.999, 0.5}), 0);
  EXPECT_EQ(grid.CellOf({2.0, 0.5}), 1);
  EXPECT_EQ(grid.CellOf({2.0, 1.0}), 3);
  EXPECT_EQ(grid.CellOf({4.0, 2.0}), 3);
}

TEST(Grid, CellsAtTheBorderReachToInfinity) {
  const Grid grid({0, 0}, {4, 2}, 4, 2);
  EXPECT_EQ(grid.CellOf({-1e30, -1e30}), 0);
  EXPECT_EQ(grid.CellOf({1e30, 1e30}), 7);
}

TEST(Grid, FlatBoxIsOneCell) {
  const Grid grid({1, 1}, {1, 1}, 3, 3);
  EXPECT_EQ(grid.CellOf({1, 1}), 0);
  EXPECT_EQ(grid.CellOf({9, 9}), 0);
}

TEST(Grid, PeriodWraps) {
  Grid grid({0.5, 0}, {3.5, 1}, 4, 1);
  grid.SetPeriod(0.0, 4.0);
  EXPECT_EQ(grid.CellOf({-0.5, 0}), 3);
  EXPECT_EQ(grid.CellOf({4.0, 0}), 0);
  EXPECT_EQ(grid.Wrap(-1e-20), 0.0);  // never the open end
  EXPECT_EQ(grid.Wrap(9.0), 1.0);
}

// Cells cover the period in equal parts, wherever the bodies are.
TEST(Grid, PeriodIsCutEvenly) {
  Grid grid({2.0, 0.0}, {4.0, 1.0}, 4, 1);
  grid.SetPeriod(1.0, 10.0);
  for (const double x : {1.0, 3.4, 3.6, 5.9, 6.1, 8.4, 8.6, 10.9}) {
    EXPECT_EQ(grid.CellOf({x, 0.5}), static_cast<int>((x - 1.0) / 2.5)) << x;
  }
}

// The cells near a point hold every point within the reach.
TEST(Grid, CellsNearAPointAreComplete) {
  for (const bool periodic : {false, true}) {
    Grid grid({0, 0}, {10, 6}, 5, 3);
    if (periodic) grid.SetPeriod(0.0, 10.0);
    for (double x = -1.0; x < 11.0; x += 0.37) {
      for (const double reach : {0.1, 1.3, 4.9, 30.0}) {
        std::set<int> near;
        grid.ForEachCellNear({grid.Wrap(x), 2.5}, reach, [&](int cell) { EXPECT_TRUE(near.insert(cell).second); });
        for (double dx = -reach; dx <= reach; dx += reach / 4) {
          for (double dy = -reach; dy <= reach; dy += reach / 4)
            EXPECT_TRUE(near.count(grid.CellOf({grid.Wrap(x) + dx, 2.5 + dy})));
        }
      }
    }
  }
}

TEST(Blocks, EveryRankHasSubdomains) {
  for (int subdomains = 1; subdomains < 40; ++subdomains) {
    for (int ranks = 1; ranks <= subdomains; ++ranks) {
      const Blocks blocks(subdomains, ranks);
      EXPECT_EQ(blocks.First(0), 0);
      EXPECT_EQ(blocks.First(ranks), subdomains);
      for (int rank = 0; rank < ranks; ++rank) {
        ASSERT_GE(blocks.Count(rank), 1);
        for (int e = blocks.First(rank); e < blocks.First(rank + 1); ++e) ASSERT_EQ(blocks.RankOf(e), rank);
      }
    }
  }
}

}  // namespace
}  // namespace nscdd
