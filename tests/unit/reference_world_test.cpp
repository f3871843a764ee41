// SPDX-License-Identifier: Apache-2.0
// The reference platform itself: bodies, filters, edits and transport.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/reference/reference_adapter.h"

namespace nscdd::reference {
namespace {

std::string SentenceOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ReferenceWorld, ClusterHasItsCentreMassAndInertia) {
  const std::vector<Disk> disks{{{1.0, 0.0}, 1.0}, {{4.0, 0.0}, 0.5}};
  const Body body = MakeCluster(3, disks, 2.0);
  const double m1 = 2.0 * M_PI, m2 = 0.5 * M_PI, x = (m1 * 1.0 + m2 * 4.0) / (m1 + m2);
  EXPECT_DOUBLE_EQ(body.mass, m1 + m2);
  EXPECT_DOUBLE_EQ(body.pose.x, x);
  EXPECT_DOUBLE_EQ(body.inertia, m1 * (0.5 + (1.0 - x) * (1.0 - x)) + m2 * (0.125 + (4.0 - x) * (4.0 - x)));
  EXPECT_DOUBLE_EQ(body.disks[1].centre.x, 4.0 - x);
}

TEST(ReferenceWorld, RefusalsNameTheBody) {
  World world;
  world.Add(MakeDisk(12, {}, 1.0, 1.0));
  const auto edited = [&](const std::function<void(Body*)>& edit) {
    return SentenceOf([&] {
      Body body = MakeDisk(77, {}, 1.0, 1.0);
      edit(&body);
      world.Add(body);
    });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::string> sentences{
      edited([](Body* b) { b->mass = 0.0; }),
      edited([](Body* b) { b->inertia = -1.0; }),
      edited([](Body* b) { b->disks.clear(); }),
      edited([](Body* b) { b->disks[0].radius = 0.0; }),
      edited([](Body* b) {
        b->segments.push_back({{0.0, 0.0}, {1.0, 0.0}});
      }),
      edited([&](Body* b) { b->pose.x = nan; }),
      edited([&](Body* b) { b->velocity.spin = nan; }),
      edited([&](Body* b) { b->force.fx = nan; }),
      edited([](Body* b) { b->friction = -0.1; }),
      edited([](Body* b) { b->restitution = 1.1; }),
      SentenceOf([&] { world.Remove(77); }),
  };
  for (const std::string& sentence : sentences) EXPECT_NE(sentence.find("77"), std::string::npos) << sentence;
  EXPECT_NE(SentenceOf([&] { world.Add(MakeDisk(12, {}, 1.0, 1.0)); }).find("12"), std::string::npos);
  EXPECT_NE(SentenceOf([&] { world.Add(MakeDisk(-1, {}, 1.0, 1.0)); }).find("-1"), std::string::npos);
  EXPECT_EQ(world.size(), 1U);
}

TEST(ReferenceWorld, FiltersAreThoseOfBox2d) {
  EXPECT_TRUE(MayTouch({}, {}));
  EXPECT_FALSE(MayTouch({1, 2, 0}, {2, 2, 0}));
  EXPECT_TRUE(MayTouch({1, 2, 0}, {2, 1, 0}));
  EXPECT_FALSE(MayTouch({1, 1, -4}, {1, 1, -4}));
  EXPECT_TRUE(MayTouch({1, 0, 4}, {1, 0, 4}));
  EXPECT_FALSE(MayTouch({1, 0, 4}, {1, 0, 5}));
}

TEST(ReferenceWorld, BodiesAreInOrderAfterEveryChange) {
  World world;
  const auto ids = [&] {
    std::vector<std::int64_t> all;
    for (const Body& body : world.bodies()) all.push_back(body.id);
    return all;
  };
  for (const std::int64_t id : {5, 1, 9}) world.Add(MakeDisk(id, {}, 1.0, 1.0));
  EXPECT_EQ(ids(), (std::vector<std::int64_t>{1, 5, 9}));
  world.Remove(5);
  world.Add(MakeDisk(7, {}, 1.0, 1.0));
  EXPECT_EQ(ids(), (std::vector<std::int64_t>{1, 7, 9}));
}

TEST(ReferenceAdapter, LoadsAreGravityAndForce) {
  World world;
  world.gravity = {0.5, -10.0};
  Body& body = world.Add(MakeDisk(1, {}, 1.0, 1.0));
  body.force = {1.0, 2.0, 3.0};
  world.Add(MakeWall(2));
  ReferenceAdapter adapter(&world);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_DOUBLE_EQ(bodies.force[0].fx, 1.0 + 0.5 * M_PI);
  EXPECT_DOUBLE_EQ(bodies.force[0].fy, 2.0 - 10.0 * M_PI);
  EXPECT_DOUBLE_EQ(bodies.force[0].torque, 3.0);
  EXPECT_EQ(bodies.radius[1], 0.0);
  body.mass = -1.0;
  EXPECT_NE(SentenceOf([&] { adapter.ReadBodies(&bodies); }).find("Body 1 "), std::string::npos);
}

TEST(ReferenceAdapter, BoundingRadiusHoldsEveryShape) {
  World world;
  Body wall = MakeWall(1);
  wall.disks = {{{3.0, 4.0}, 1.0}};
  wall.segments = {{{0.0, 0.0}, {0.0, 7.0}}};
  Body& added = world.Add(wall);
  ReferenceAdapter adapter(&world);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  EXPECT_EQ(bodies.bounding_radius[0], 7.0);
  EXPECT_EQ(bodies.radius[0], 1.0);
  added.half_planes.push_back({});
  adapter.ReadBodies(&bodies);
  EXPECT_TRUE(std::isinf(bodies.bounding_radius[0]));
}

TEST(ReferenceAdapter, TransportKeepsEverything) {
  World here, there;
  Body wall = MakeWall(6, {1.0, 2.0, 3.0});
  wall.velocity = {4.0, 5.0, 6.0};
  wall.force = {7.0, 8.0, 9.0};
  wall.disks = {{{0.1, 0.2}, 0.3}};
  wall.segments = {{{1.0, 0.0}, {2.0, 0.0}}, {{2.0, 0.0}, {2.0, 5.0}}};
  wall.half_planes = {{{1.0, 0.0}, -4.0}};
  wall.friction = 0.4;
  wall.restitution = 0.5;
  wall.filter = {2, 3, -1};
  here.Add(wall);
  ReferenceAdapter from(&here), to(&there);
  std::vector<std::byte> bytes(3);  // Pack appends
  from.transport()->Pack(6, &bytes);
  to.transport()->Insert(6, std::span(bytes).subspan(3));
  from.transport()->Remove(6);
  EXPECT_EQ(here.size(), 0U);
  const Body* moved = there.Find(6);
  ASSERT_NE(moved, nullptr);
  EXPECT_EQ(moved->kind, BodyKind::kPrescribed);
  EXPECT_EQ(moved->pose.angle, 3.0);
  EXPECT_EQ(moved->velocity.spin, 6.0);
  EXPECT_EQ(moved->force.torque, 9.0);
  EXPECT_EQ(moved->disks[0].radius, 0.3);
  EXPECT_EQ(moved->segments[1].b.y, 5.0);
  EXPECT_EQ(moved->half_planes[0].offset, -4.0);
  EXPECT_EQ(moved->friction, 0.4);
  EXPECT_EQ(moved->restitution, 0.5);
  EXPECT_EQ(moved->filter.group, -1);
  EXPECT_NE(SentenceOf([&] { to.transport()->Insert(6, std::span(bytes).subspan(3)); }).find("6"), std::string::npos);
  EXPECT_NE(SentenceOf([&] { to.transport()->Insert(7, std::span(bytes).subspan(3)); }).find("7"), std::string::npos);
  EXPECT_NE(SentenceOf([&] { to.transport()->Insert(8, std::span(bytes).subspan(3, 50)); }), "");
  EXPECT_EQ(there.size(), 1U);
}

TEST(ReferenceAdapter, RefusesAnImpossiblePeriod) {
  World world;
  world.period = -1.0;
  EXPECT_THROW(ReferenceAdapter{&world}, Error);
}

}  // namespace
}  // namespace nscdd::reference
