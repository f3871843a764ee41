// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "scene/body_stream.h"
#include "scene/disk_file.h"
#include "scene/read_scene.h"
#include "scene_files.h"

namespace nscdd {
namespace {

const std::string kTime = "[time]\ndt = 0.01\nsteps = 3\n";

std::vector<BodyDefinition> Bodies(const Scene& scene, int rank = 0, int ranks = 1) {
  std::vector<BodyDefinition> bodies;
  ForEachBody(scene, rank, ranks, [&](const BodyDefinition& body) { bodies.push_back(body); });
  return bodies;
}

void ExpectSame(const BodyDefinition& a, const BodyDefinition& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.pose.x, b.pose.x);
  EXPECT_EQ(a.pose.y, b.pose.y);
  EXPECT_EQ(a.pose.angle, b.pose.angle);
  EXPECT_EQ(a.disks.size(), b.disks.size());
}

/// A scene with every kind of source.
Scene MixedScene(const TestFolder& folder) {
  folder.Write("d.csv", "id,x,y,radius,angle,vx,spin\n500,1,2,0.5,0.1,3,4\n100,5,6,0.25,0,0,0\n300,7,8,1,0,0,0\n");
  return ReadSceneFile(folder.Write("mixed.toml", kTime + R"(
[[materials]]
name = "soft"
density = 2
[[walls]]
type = "disks"
points = [[0, -1], [10, -1]]
radius = 1
one_body = false
[[disks]]
file = "d.csv"
[[lattices]]
count = 11
x = [0, 10]
bottom = 0
radius = [0.5, 1]
jitter = 0.1
seed = 9
[[depositions]]
count = 13
x = [0, 10]
bottom = 20
radius = [0.5, 1]
[[clusters]]
disks = [[0, 0, 1], [1, 0, 1]]
at = [[0, 50, 0], [5, 50, 1]]
)"));
}

TEST(SceneBodies, RanksTogetherGiveEveryBodyOnceInOrder) {
  const TestFolder folder;
  const Scene scene = MixedScene(folder);
  const std::vector<BodyDefinition> all = Bodies(scene);
  ASSERT_EQ(all.size(), 6u + 3 + 11 + 13 + 2);
  for (const int ranks : {1, 2, 3, 4, 7, 50}) {
    std::vector<BodyDefinition> together;
    for (int rank = 0; rank < ranks; ++rank) {
      for (const BodyDefinition& body : Bodies(scene, rank, ranks)) {
        EXPECT_EQ(static_cast<int>(together.size() * static_cast<std::size_t>(ranks) / all.size()), rank);
        together.push_back(body);
      }
    }
    ASSERT_EQ(together.size(), all.size()) << ranks;
    for (std::size_t k = 0; k < all.size(); ++k) ExpectSame(together[k], all[k]);
  }
}

TEST(SceneBodies, CsvColumnsAndSourceKeysArrive) {
  const TestFolder folder;
  const std::vector<BodyDefinition> bodies = Bodies(MixedScene(folder));
  const BodyDefinition& body = bodies.at(6);
  EXPECT_EQ(body.id, 500);
  EXPECT_EQ(body.pose.x, 1.0);
  EXPECT_EQ(body.pose.y, 2.0);
  EXPECT_EQ(body.pose.angle, 0.1);
  EXPECT_EQ(body.velocity.vx, 3.0);
  EXPECT_EQ(body.velocity.vy, 0.0);
  EXPECT_EQ(body.velocity.spin, 4.0);
  EXPECT_EQ(body.disks.at(0).radius, 0.5);
  EXPECT_DOUBLE_EQ(body.mass, 2.0 * std::numbers::pi * 0.25);
  EXPECT_EQ(bodies.at(9).id, 6) << "bodies without an id take those that are free, in their order";
}

TEST(SceneBodies, AFileThatShrankIsNoticed) {
  const TestFolder folder;
  const Scene scene = MixedScene(folder);
  folder.Write("d.csv", "id,x,y,radius,angle,vx,spin\n500,1,2,0.5,0.1,3,4\n");
  EXPECT_THROW(Bodies(scene), Error);
}

TEST(SceneBodies, LatticeIsFixedBySeedAndKeepsItsBounds) {
  const Lattice lattice{.left = 0,
                        .right = 20,
                        .bottom = 1,
                        .min_radius = 0.5,
                        .max_radius = 1,
                        .spacing = 2.2,
                        .jitter = 0.1,
                        .hexagonal = false,
                        .seed = 3};
  Lattice other = lattice;
  other.seed = 4;
  EXPECT_EQ(LatticeColumns(lattice), 9);
  bool differs = false;
  for (std::int64_t k = 0; k < 50; ++k) {
    const reference::Disk disk = LatticeDisk(lattice, k);
    EXPECT_EQ(disk.centre.x, LatticeDisk(lattice, k).centre.x);
    differs = differs || disk.radius != LatticeDisk(other, k).radius;
    EXPECT_GE(disk.radius, 0.5);
    EXPECT_LE(disk.radius, 1.0);
    EXPECT_GE(disk.centre.x - disk.radius, 0.0);
    EXPECT_LE(disk.centre.x + disk.radius, 20.0);
    EXPECT_GE(disk.centre.y - disk.radius, 1.0);
    for (std::int64_t j = 0; j < k; ++j) {
      const reference::Disk before = LatticeDisk(lattice, j);
      EXPECT_GE(Norm(before.centre - disk.centre), before.radius + disk.radius);
    }
  }
  EXPECT_TRUE(differs);
}

TEST(SceneBodies, HexagonalRowsAreShiftedByHalfASpacing) {
  const Lattice lattice{.left = 0,
                        .right = 7,
                        .bottom = 0,
                        .min_radius = 1,
                        .max_radius = 1,
                        .spacing = 2,
                        .jitter = 0,
                        .hexagonal = true,
                        .seed = 0};
  EXPECT_EQ(LatticeColumns(lattice), 3);
  EXPECT_EQ(LatticeDisk(lattice, 0).centre.x, 1.0);
  EXPECT_EQ(LatticeDisk(lattice, 3).centre.x, 2.0);
  EXPECT_NEAR(Norm(LatticeDisk(lattice, 3).centre - LatticeDisk(lattice, 1).centre), 2.0, 1e-15);
}

/// Contacts of each disk with earlier ones, the sides and the floor, gap below 1e-9; fails on any overlap.
std::vector<int> Supports(const Deposition& bed, const std::vector<reference::Disk>& disks) {
  std::vector<int> supports(disks.size());
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const auto count = [&](double gap) {
      EXPECT_GT(gap, -1e-9) << k;
      supports[k] += gap < 1e-9 ? 1 : 0;
    };
    count(disks[k].centre.x - disks[k].radius - bed.left);
    count(bed.right - disks[k].centre.x - disks[k].radius);
    count(disks[k].centre.y - disks[k].radius - bed.bottom);
    for (std::size_t j = 0; j < k; ++j) count(Norm(disks[k].centre - disks[j].centre) - disks[k].radius - disks[j].radius);
  }
  return supports;
}

TEST(SceneBodies, DepositedDisksRestOnTwoOthersWithoutOverlap) {
  for (const std::uint64_t seed : {0u, 1u, 2u}) {
    const Deposition bed{.left = -3, .right = 25, .bottom = 2, .min_radius = 0.4, .max_radius = 1.3, .seed = seed};
    DepositionGenerator generator(bed), again(bed);
    std::vector<reference::Disk> disks;
    double area = 0.0, top = 0.0;
    for (int k = 0; k < 600; ++k) {
      disks.push_back(generator.Next());
      const reference::Disk twin = again.Next();
      EXPECT_EQ(disks.back().centre.x, twin.centre.x);
      EXPECT_EQ(disks.back().centre.y, twin.centre.y);
      area += std::numbers::pi * disks.back().radius * disks.back().radius;
      top = std::max(top, disks.back().centre.y);
    }
    const std::vector<int> supports = Supports(bed, disks);
    EXPECT_GE(std::count_if(supports.begin(), supports.end(), [](int n) { return n >= 2; }), 598)
        << "all but the first and the one at its side";
    EXPECT_GT(area / (28.0 * (top - bed.bottom)), 0.74) << "the packing is dense";
  }
}

TEST(SceneBodies, ABoxHardlyWiderThanOneDiskFillsUp) {
  const Deposition bed{.left = 0, .right = 2.05, .bottom = 0, .min_radius = 0.5, .max_radius = 1, .seed = 1};
  DepositionGenerator generator(bed);
  std::vector<reference::Disk> disks;
  for (int k = 0; k < 100; ++k) disks.push_back(generator.Next());
  Supports(bed, disks);
}

TEST(SceneBodies, ClusterMassIsTheSumOverItsDisks) {
  const TestFolder folder;
  const std::vector<BodyDefinition> bodies = Bodies(ReadSceneFile(folder.Write("c.toml", kTime + R"(
[[materials]]
name = "m"
density = 3
[[clusters]]
disks = [[1, 0, 1], [3, 0, 1]]
at = [[10, 20, 1.5707963267948966]]
[[clusters]]
disks = [[0, 0, 1]]
mass = 5
inertia = 7
)")));
  const double disk = 3 * std::numbers::pi;
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_DOUBLE_EQ(bodies[0].mass, 2 * disk);
  EXPECT_DOUBLE_EQ(bodies[0].inertia, 2 * disk * (0.5 + 1.0));
  EXPECT_NEAR(bodies[0].pose.x, 10.0, 1e-12);
  EXPECT_NEAR(bodies[0].pose.y, 22.0, 1e-12);
  EXPECT_EQ(bodies[0].disks.at(0).centre.x, -1.0);
  EXPECT_EQ(bodies[1].mass, 5.0);
  EXPECT_EQ(bodies[1].inertia, 7.0);
}

TEST(SceneBodies, WallsAreSeenFromTheirCentre) {
  const TestFolder folder;
  const std::vector<BodyDefinition> bodies = Bodies(ReadSceneFile(folder.Write("w.toml", kTime + R"(
[[walls]]
type = "segments"
circle = [1, 2, 5]
sides = 4
spin = 0.5
[[walls]]
type = "half_plane"
point = [3, 4]
normal = [3, 4]
[[walls]]
type = "disks"
points = [[0, 0], [4, 0], [4, 4], [0, 4]]
closed = true
radius = 1
spacing = 1
velocity = [1, 0]
[[disks]]
centre = [0, 9]
radius = 1
)")));
  ASSERT_EQ(bodies.size(), 4u);
  EXPECT_EQ(bodies[0].segments.size(), 4u);
  EXPECT_NEAR(bodies[0].pose.x, 1.0, 1e-12);
  EXPECT_EQ(bodies[0].velocity.spin, 0.5);
  EXPECT_NEAR(Norm(bodies[0].segments[1].a), 5.0, 1e-12);
  EXPECT_EQ(bodies[1].half_planes.at(0).normal.x, 0.6);
  EXPECT_NEAR(bodies[1].half_planes[0].offset, 0.0, 1e-15);
  EXPECT_EQ(bodies[2].disks.size(), 16u);
  EXPECT_EQ(bodies[2].pose.x, 2.0);
  EXPECT_EQ(bodies[2].velocity.vx, 1.0);
  EXPECT_EQ(bodies[2].kind, BodyKind::kPrescribed);
}

TEST(SceneBodies, PackingReadsBackBitForBit) {
  const TestFolder folder;
  const Scene scene = ReadSceneFile(folder.Write("l.toml", kTime + R"(
[[walls]]
type = "half_plane"
point = [0, 0]
[[lattices]]
count = 5
x = [0, 30]
bottom = 0
radius = [0.7, 1.3]
)"));
  const auto final_csv = folder.Write("final.csv",
                                      "id,x,y,angle,vx,vy,spin\n0,0,0,0,0,0,0\n1,0.10000000000000001,2,3,9,8,7\n2,4,5,6,9,9,9\n"
                                      "3,7,8,0.33333333333333331,9,9,9\n4,1,1,1,1,1,1\n5,2,2,2,2,2,2\n");
  const std::string note = WritePacking(scene, final_csv, folder.path() / "p.csv");
  EXPECT_NE(note.find("not in it: 1 wall, the impulses"), std::string::npos) << note;
  const std::vector<BodyDefinition> loose = Bodies(scene);
  const std::vector<BodyDefinition> settled = Bodies(ReadSceneFile(
      folder.Write("p.toml", kTime + "[[walls]]\ntype = \"half_plane\"\npoint = [0, 0]\n[[disks]]\nfile = \"p.csv\"\n")));
  ASSERT_EQ(settled.size(), 6u);
  for (std::size_t k = 1; k < 6; ++k) {
    EXPECT_EQ(settled[k].id, static_cast<std::int64_t>(k));
    EXPECT_EQ(settled[k].disks[0].radius, loose[k].disks[0].radius);
  }
  EXPECT_EQ(settled[1].pose.x, 0.1);
  EXPECT_EQ(settled[1].velocity.vx, 9.0);
  EXPECT_EQ(settled[1].velocity.vy, 8.0);
  EXPECT_EQ(settled[1].velocity.spin, 7.0);
  EXPECT_EQ(settled[3].pose.angle, 1.0 / 3.0);
}

}  // namespace
}  // namespace nscdd
