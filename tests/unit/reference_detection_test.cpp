// SPDX-License-Identifier: Apache-2.0
// Contacts of the reference adapter in particular configurations, and against a plain double loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/reference/reference_adapter.h"

namespace nscdd::reference {
namespace {

ContactTable Detect(World* world, double alert) {
  ReferenceAdapter adapter(world);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  ContactTable contacts;
  adapter.DetectContacts({bodies.id, bodies.pose}, alert, &contacts);
  return contacts;
}

using Pair = std::tuple<int, int, int, int, int>;

std::vector<Pair> PairsOf(const ContactTable& contacts) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    pairs.emplace_back(contacts.a[i], contacts.b[i], contacts.shape_a[i], contacts.shape_b[i],
                       contacts.has_images() ? contacts.image[i] : 0);
  }
  return pairs;
}

/// Disk pairs by a double loop over bodies (rows), disks and images.
std::vector<Pair> PlainPairs(const World& world, double alert) {
  std::vector<Pair> pairs;
  const int images = world.period > 0.0 ? 9 : 0;
  const auto all = world.bodies();
  for (int a = 0; a < std::ssize(all); ++a) {
    for (int b = a + 1; b < std::ssize(all); ++b) {
      if (all[a].kind == BodyKind::kPrescribed && all[b].kind == BodyKind::kPrescribed) continue;
      for (int sa = 0; sa < std::ssize(all[a].disks); ++sa) {
        for (int sb = 0; sb < std::ssize(all[b].disks); ++sb) {
          const Disk &da = all[a].disks[static_cast<std::size_t>(sa)], &db = all[b].disks[static_cast<std::size_t>(sb)];
          const Vec2 ca = Centre(all[a].pose) + Rotate(all[a].pose.angle, da.centre);
          const Vec2 cb = Centre(all[b].pose) + Rotate(all[b].pose.angle, db.centre);
          for (int k = -images; k <= images; ++k) {
            const Vec2 d{cb.x + k * world.period - ca.x, cb.y - ca.y};
            if (std::sqrt(Dot(d, d)) - (da.radius + db.radius) <= alert) pairs.emplace_back(a, b, sa, sb, k);
          }
        }
      }
    }
  }
  return pairs;
}

/// Disks of very different sizes, clusters and fixed disks, some of them far away.
void Fill(std::uint64_t seed, int count, double extent, World* world) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> place(0.0, extent), size(-2.5, 0.0), arm(-0.5, 0.5);
  for (int i = 0; i < count; ++i) {
    const Vec2 centre{place(engine), place(engine)};
    std::vector<Disk> disks(1, {centre, std::pow(10.0, size(engine))});
    while (i % 5 == 0 && disks.size() < 3) disks.push_back({centre + Vec2{arm(engine), arm(engine)}, 0.2});
    Body body = MakeCluster(3 * i, disks, 1.0);
    if (i % 7 == 0) body.kind = BodyKind::kPrescribed;
    if (world->period == 0.0 && i % 97 == 0) body.pose.x += 1e6 * extent;
    body.pose.angle = arm(engine);
    world->Add(body);
  }
}

TEST(ReferenceDetection, FindsThePairsOfADoubleLoop) {
  for (const double alert : {0.0, 0.05, 3.0}) {
    World world;
    Fill(1, 600, 12.0, &world);
    const auto found = PairsOf(Detect(&world, alert));
    EXPECT_EQ(found, PlainPairs(world, alert)) << "alert " << alert;
    EXPECT_GT(found.size(), 300U);
  }
}

TEST(ReferenceDetection, FindsPeriodicPairsOfADoubleLoop) {
  for (const double period : {4.0, 6.0, 13.0}) {
    World world;
    world.period = period;
    world.period_origin = -1.0;
    Fill(2, 200, 20.0, &world);  // centres up to five periods away
    const auto found = PairsOf(Detect(&world, 0.05));
    EXPECT_EQ(found, PlainPairs(world, 0.05)) << "period " << period;
  }
}

TEST(ReferenceDetection, KeepsBothImagesOfAPair) {
  World world;
  world.period = 3.0;
  world.Add(MakeDisk(1, {0.5, 0.0}, 0.8, 1.0));
  world.Add(MakeDisk(2, {2.0, 0.0}, 0.8, 1.0));
  const ContactTable contacts = Detect(&world, 0.0);
  EXPECT_EQ(PairsOf(contacts), (std::vector<Pair>{{0, 1, 0, 0, -1}, {0, 1, 0, 0, 0}}));
  EXPECT_NEAR(contacts.gap[0], -0.1, 1e-15);
  EXPECT_DOUBLE_EQ(contacts.normal[0].x, -1.0);
  EXPECT_DOUBLE_EQ(contacts.normal[1].x, 1.0);
}

TEST(ReferenceDetection, RefusesAPeriodThatABodyFills) {
  World world;
  world.period = 1.5;
  world.Add(MakeDisk(8, {0.0, 0.0}, 0.8, 1.0));
  try {
    Detect(&world, 0.0);
    FAIL() << "a disk as wide as the period was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("Body 8"), std::string::npos) << error.what();
  }
}

TEST(ReferenceDetection, CoincidentCentresHaveANormal) {
  World world;
  world.Add(MakeDisk(1, {2.0, 3.0}, 1.0, 1.0));
  world.Add(MakeDisk(2, {2.0, 3.0}, 0.5, 1.0));
  const ContactTable contacts = Detect(&world, 0.1);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts.normal[0].x, 0.0);
  EXPECT_EQ(contacts.normal[0].y, 1.0);
  EXPECT_EQ(contacts.gap[0], -1.5);
  EXPECT_EQ(contacts.lever_a[0] + contacts.lever_b[0], 0.0);
}

/// A floor from (-2, 0) to (0, 0) to (2, 0) and on to `end`, and a disk of radius 1 at `centre`.
ContactTable OnFloor(Vec2 end, Vec2 centre) {
  World world;
  Body floor = MakeWall(0);
  floor.segments = {{{-2.0, 0.0}, {0.0, 0.0}}, {{0.0, 0.0}, {2.0, 0.0}}, {{2.0, 0.0}, end}};
  world.Add(floor);
  world.Add(MakeDisk(1, centre, 1.0, 1.0));
  return Detect(&world, 0.1);
}

TEST(ReferenceDetection, JoinedSegmentsDoNotDoubleContacts) {
  const Vec2 level{4.0, 0.0};
  for (const double x : {-1.0, -1e-3, -1e-12, 0.0, 1e-12, 1e-3, 1.99, 2.0}) {
    const ContactTable contacts = OnFloor(level, {x, 1.05});
    ASSERT_EQ(contacts.size(), 1U) << "x " << x;
    EXPECT_NEAR(contacts.gap[0], 0.05, 1e-14);
    EXPECT_NEAR(contacts.normal[0].y, 1.0, 1e-14);
  }
}

TEST(ReferenceDetection, GrooveAndRidgeOfAPolyline) {
  // A groove: the third segment rises; the disk touches both flat sides and not the corner between them.
  const ContactTable groove = OnFloor({2.0, 4.0}, {1.0, 1.0});
  ASSERT_EQ(groove.size(), 2U);
  EXPECT_EQ(groove.flat[0] + groove.flat[1], 2);
  // A ridge: the third segment falls steeply; beyond the corner the disk is in front of no flat side and touches it once.
  const ContactTable ridge = OnFloor({2.2, -4.0}, {2.5, 0.9});
  ASSERT_EQ(ridge.size(), 1U);
  EXPECT_EQ(ridge.shape_a[0], 1);
  EXPECT_EQ(ridge.flat[0], 0);
  EXPECT_NEAR(ridge.gap[0], std::hypot(0.5, 0.9) - 1.0, 1e-15);
  EXPECT_NEAR(ridge.lever_b[0], std::hypot(0.5, 0.9), 1e-15);
  EXPECT_EQ(ridge.lever_a[0], 0.0);
  // A free end is a corner too.
  const ContactTable end = OnFloor({4.0, 0.0}, {4.5, 0.9});
  ASSERT_EQ(end.size(), 1U);
  EXPECT_EQ(end.flat[0], 0);
}

TEST(ReferenceDetection, SegmentsAreTwoSided) {
  const ContactTable contacts = OnFloor({4.0, 0.0}, {-1.0, -1.05});
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts.normal[0].y, -1.0, 1e-15);
}

TEST(ReferenceDetection, PeriodicFloorOfOneSegmentHasNoSeam) {
  for (const double x : {-7.9, -0.5, -1e-13, 0.0, 0.4, 3.0, 5.0, 9.999, 10.0, 23.0}) {
    World world;
    world.period = 10.0;
    Body floor = MakeWall(5, {5.0, 0.0, 0.0});
    floor.segments = {{{-5.0, 0.0}, {5.0, 0.0}}};
    world.Add(floor);
    world.Add(MakeDisk(1, {x, 1.0}, 1.0, 1.0));
    const ContactTable contacts = Detect(&world, 0.1);
    ASSERT_EQ(contacts.size(), 1U) << "x " << x;
    EXPECT_NEAR(contacts.gap[0], 0.0, 1e-14);
    EXPECT_NEAR(contacts.site[0].x, x, 1e-12) << "the point on the wall is below the disk, the wall being B and shifted";
  }
}

TEST(ReferenceDetection, LongSegmentsFindWhatAPlainLoopFinds) {
  World world;
  Fill(4, 3000, 10.0, &world);
  Body wall = MakeWall(100000, {5.0, 5.0, 0.3});
  wall.segments = {{{-40.0, 0.2}, {50.0, 0.1}}, {{0.0, -6.0}, {0.3, 6.0}}, {{1.0, 1.0}, {1.5, 1.9}}};
  world.Add(wall);
  const ContactTable contacts = Detect(&world, 0.05);
  const auto all = world.bodies();
  for (std::size_t s = 0; s < wall.segments.size(); ++s) {
    std::size_t expected = 0, found = 0;
    const Vec2 a = Centre(wall.pose) + Rotate(wall.pose.angle, wall.segments[s].a);
    const Vec2 b = Centre(wall.pose) + Rotate(wall.pose.angle, wall.segments[s].b);
    for (const Body& body : all) {
      if (body.kind == BodyKind::kPrescribed) continue;
      for (const Disk& disk : body.disks) {
        const Vec2 c = Centre(body.pose) + Rotate(body.pose.angle, disk.centre);
        const double t = std::clamp(Dot(c - a, b - a) / Dot(b - a, b - a), 0.0, 1.0);
        if (Norm(c - (a + t * (b - a))) - disk.radius <= 0.05) ++expected;
      }
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (all[contacts.b[i]].id == wall.id && contacts.shape_b[i] == static_cast<int>(s)) ++found;
    }
    EXPECT_EQ(found, expected) << "segment " << s;
    EXPECT_GT(expected, 0U) << "segment " << s;
  }
}

TEST(ReferenceDetection, RotatedHalfPlaneActsOnArms) {
  World world;
  Body slope = MakeWall(9, {1.0, 2.0, M_PI / 6.0});
  slope.half_planes = {{{0.0, 1.0}, 0.5}};
  world.Add(slope);
  const Vec2 n = Rotate(M_PI / 6.0, {0.0, 1.0});
  world.Add(MakeDisk(4, Vec2{1.0, 2.0} + 1.47 * n, 1.0, 1.0));
  const ContactTable contacts = Detect(&world, 0.0);
  ASSERT_EQ(contacts.size(), 1U);  // A is the disk: the normal leads into the wall
  EXPECT_NEAR(contacts.gap[0], -0.03, 1e-15);
  EXPECT_NEAR(Dot(contacts.normal[0], n), -1.0, 1e-15);
  EXPECT_NEAR(contacts.lever_a[0], 0.97, 1e-15);
  EXPECT_NEAR(contacts.arm_b[0].x, 0.5 * n.x, 1e-15);
  EXPECT_NEAR(contacts.arm_b[0].y, 0.5 * n.y, 1e-15);
}

TEST(ReferenceDetection, DisksAloneHaveNoArmsAndNoImages) {
  World world;
  world.Add(MakeDisk(1, {0.0, 0.0}, 1.0, 1.0));
  world.Add(MakeDisk(2, {2.0, 0.0}, 1.0, 1.0));
  const ContactTable contacts = Detect(&world, 0.0);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_FALSE(contacts.has_arms());
  EXPECT_FALSE(contacts.has_images());
}

// The site of a contact is never further from the disk than it reaches, or no rank would look for it there.
TEST(ReferenceDetection, SiteOfADeepDiskIsItsCentre) {
  World world;
  Body wall = MakeWall(0);
  wall.half_planes.push_back({});
  world.Add(wall);
  world.Add(MakeDisk(1, {2.0, -4.0}, 0.5, 1.0));
  world.Add(MakeDisk(2, {7.0, 0.4}, 0.5, 1.0));
  const ContactTable c = Detect(&world, 0.1);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(c.gap[0], -4.5);
  EXPECT_EQ(c.site[0].y, -4.0);
  EXPECT_EQ(c.site[1].y, 0.0);
}

}  // namespace
}  // namespace nscdd::reference
