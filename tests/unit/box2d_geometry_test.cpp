// SPDX-License-Identifier: Apache-2.0
// Gaps, frames, levers and arms of the Box2D adapter against closed forms.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "box2d_support.h"

namespace nscdd::box2d {
namespace {

class Box2dGeometry : public testing::Test {
 protected:
  b2World world_{{0.0f, 0.0f}};
  Box2dAdapter adapter_{&world_};
};

TEST_F(Box2dGeometry, TwoDisksMeetHalfWay) {
  AddDisk(&world_, {0.0f, 0.0f}, 1.0f);
  AddDisk(&world_, {3.0f, 4.0f}, 3.5f);
  const ContactTable c = Detect(&adapter_, 0.6);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_DOUBLE_EQ(c.gap[0], 0.5);
  EXPECT_DOUBLE_EQ(c.normal[0].x, 0.6);
  EXPECT_DOUBLE_EQ(c.normal[0].y, 0.8);
  EXPECT_DOUBLE_EQ(c.lever_a[0], 1.25);
  EXPECT_DOUBLE_EQ(c.lever_b[0], 3.75);
  EXPECT_DOUBLE_EQ(c.site[0].x, 1.5);
  EXPECT_DOUBLE_EQ(c.site[0].y, 2.0);
  EXPECT_EQ(c.flat[0], 0);
  EXPECT_FALSE(c.has_arms());
  EXPECT_FALSE(c.has_images());
}

TEST_F(Box2dGeometry, GapIsDoublePrecisionFarFromTheOrigin) {
  for (const double place : {10.0, 1e3, 1e4, 1e6}) {
    b2World world({0.0f, 0.0f});
    Box2dAdapter adapter(&world);
    const double gap = 1.2345678901234e-3, radius = 0.7;
    for (int i = 0; i < 2; ++i) {
      ExactBody exact;
      exact.pose = Pose{place, -place + i * (2.0 * radius + gap), 0.1};
      exact.shapes = {{DiskGeometry{{}, radius}, {}, {}}};
      adapter.Assign(AddDisk(&world, {static_cast<float>(place), 0.0f}, 0.7f), i, exact);
    }
    const ContactTable c = Detect(&adapter, 0.01);
    ASSERT_EQ(c.size(), 1u) << place;
    EXPECT_NEAR(c.gap[0], gap, 4e-16 * place) << place;
  }
}

TEST_F(Box2dGeometry, CoincidentCentresHaveAFixedNormal) {
  AddDisk(&world_, {2.0f, 2.0f});
  AddDisk(&world_, {2.0f, 2.0f});
  const ContactTable c = Detect(&adapter_, 0.0);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c.gap[0], -2.0);
  EXPECT_EQ(c.normal[0].x, 0.0);
  EXPECT_EQ(c.normal[0].y, 1.0);
}

TEST_F(Box2dGeometry, WallHasNoSkinAndTheWallsSideOfTheFrame) {
  b2Body* ground = AddBody(&world_, b2_staticBody, {1.0f, 0.5f});
  AddEdge(ground, {-10.0f, 0.0f}, {10.0f, 0.0f});
  AddDisk(&world_, {3.0f, 1.5f});
  const ContactTable c = Detect(&adapter_, 0.0);
  ASSERT_EQ(c.size(), 1u) << "a gap of exactly zero is within alert 0";
  EXPECT_EQ(c.gap[0], 0.0);
  EXPECT_EQ(c.normal[0].y, 1.0);
  EXPECT_EQ(c.lever_a[0], 0.0);
  EXPECT_EQ(c.lever_b[0], 1.0);
  EXPECT_EQ(c.flat[0], 1);
  EXPECT_EQ(c.site[0].x, 3.0);
  EXPECT_EQ(c.site[0].y, 0.5);
  ASSERT_TRUE(c.has_arms());
  EXPECT_EQ(c.arm_a[0].x, 2.0);
  EXPECT_EQ(c.arm_a[0].y, 0.0);
  EXPECT_EQ(c.arm_b[0].x, 0.0);
}

TEST_F(Box2dGeometry, DiskWithTheSmallerIdIsA) {
  AddDisk(&world_, {0.0f, 1.1f});
  AddEdge(AddBody(&world_, b2_staticBody, {0.0f, 0.0f}), {-1.0f, 0.0f}, {1.0f, 0.0f});
  const ContactTable c = Detect(&adapter_, 0.2);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c.normal[0].y, -1.0);
  EXPECT_NEAR(c.lever_a[0], 1.1, 1e-7);
  EXPECT_EQ(c.lever_b[0], 0.0);
}

TEST_F(Box2dGeometry, EndOfAnEdgeIsACorner) {
  AddEdge(AddBody(&world_, b2_staticBody, {0.0f, 0.0f}), {-1.0f, 0.0f}, {1.0f, 0.0f});
  AddDisk(&world_, {1.75f, 1.0f}, 1.0f);
  const ContactTable c = Detect(&adapter_, 0.5);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_DOUBLE_EQ(c.gap[0], 0.25);
  EXPECT_DOUBLE_EQ(c.normal[0].x, 0.6);
  EXPECT_DOUBLE_EQ(c.normal[0].y, 0.8);
  EXPECT_EQ(c.flat[0], 0);
  EXPECT_DOUBLE_EQ(c.site[0].x, 1.0);
}

class Box2dChain : public Box2dGeometry {
 protected:
  void SetUp() override {
    const b2Vec2 points[] = {{-4.0f, 0.0f}, {-2.0f, 0.0f}, {0.0f, 0.0f}, {2.0f, 0.0f}, {2.0f, -2.0f}};
    b2ChainShape chain;
    chain.CreateChain(points, 5, {-6.0f, 0.0f}, {2.0f, -4.0f});
    AddBody(&world_, b2_staticBody, {0.0f, 0.0f})->CreateFixture(&chain, 0.0f);
    disk_ = AddDisk(&world_, {0.0f, 1.0f});
  }
  ContactTable At(double x, double y) {
    Detect(&adapter_, 0.1);
    adapter_.SetPose(1, {x, y, 0.0});
    return Detect(&adapter_, 0.1);
  }
  b2Body* disk_ = nullptr;
};

TEST_F(Box2dChain, RollingOverAJointMeetsOneFlatLine) {
  for (int i = -200; i <= 200; ++i) {
    const double x = 0.005 * i;
    const ContactTable c = At(x, 1.0);
    ASSERT_EQ(c.size(), 1u) << x;
    EXPECT_EQ(c.gap[0], 0.0) << x;
    EXPECT_EQ(c.normal[0].x, 0.0) << x;
    EXPECT_EQ(c.normal[0].y, 1.0) << x;
    EXPECT_EQ(c.shape_a[0], x <= 0.0 ? 1 : 2) << x;
  }
}

TEST_F(Box2dChain, ConvexCornerIsMetOnce) {
  const ContactTable c = At(2.0 + 0.6, 0.8);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c.shape_a[0], 2);
  EXPECT_NEAR(c.gap[0], 0.0, 1e-15);
  EXPECT_NEAR(c.normal[0].x, 0.6, 1e-15);
  EXPECT_EQ(c.flat[0], 0);
}

TEST_F(Box2dChain, ConcaveCornerIsTwoFlatSides) {
  const ContactTable c = At(1.0, -1.0);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(c.shape_a[0], 2);
  EXPECT_EQ(c.shape_a[1], 3);
  EXPECT_EQ(c.normal[0].y, -1.0);
  EXPECT_EQ(c.normal[1].x, -1.0);
  EXPECT_EQ(c.flat[0] + c.flat[1], 2);
}

TEST_F(Box2dChain, WrongSideIsNotLost) {
  const ContactTable c = At(-3.0, -1.05);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c.gap[0], 0.05, 1e-15);
  EXPECT_EQ(c.normal[0].y, -1.0);
}

TEST_F(Box2dChain, FreeEndIsACornerWhateverTheGhostSays) {
  const ContactTable c = At(-4.6, 0.8);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c.gap[0], 0.0, 1e-15);
  EXPECT_NEAR(c.normal[0].x, -0.6, 1e-15);
}

TEST_F(Box2dGeometry, EdgesOfOneBodyJoinToo) {
  b2Body* ground = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  b2EdgeShape edge;
  edge.SetOneSided({-4.0f, 0.0f}, {-2.0f, 0.0f}, {0.0f, 0.0f}, {2.0f, 0.0f});
  ground->CreateFixture(&edge, 0.0f);
  AddEdge(ground, {2.0f, 0.0f}, {0.0f, 0.0f});
  AddDisk(&world_, {0.25f, 1.0f});
  const ContactTable c = Detect(&adapter_, 0.1);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c.shape_a[0], 1);
  EXPECT_EQ(c.flat[0], 1);
}

TEST_F(Box2dGeometry, PolygonIsSolid) {
  b2Body* box = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  b2PolygonShape shape;
  shape.SetAsBox(2.0f, 1.0f);
  box->CreateFixture(&shape, 0.0f);
  AddDisk(&world_, {0.5f, 1.5f}, 0.5f);      // on the top
  AddDisk(&world_, {2.375f, 1.5f}, 0.625f);  // at the corner
  AddDisk(&world_, {-0.25f, -0.75f}, 0.5f);  // centre inside, nearest to the bottom
  const ContactTable c = Detect(&adapter_, 0.1);
  std::vector<std::size_t> of_box;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c.a[i] == 0) of_box.push_back(i);
  }
  ASSERT_EQ(of_box.size(), 3u);
  EXPECT_DOUBLE_EQ(c.gap[of_box[0]], 0.0);
  EXPECT_EQ(c.normal[of_box[0]].y, 1.0);
  EXPECT_EQ(c.flat[of_box[0]], 1);
  EXPECT_DOUBLE_EQ(c.gap[of_box[1]], 0.0);
  EXPECT_DOUBLE_EQ(c.normal[of_box[1]].x, 0.6);
  EXPECT_EQ(c.flat[of_box[1]], 0);
  EXPECT_DOUBLE_EQ(c.gap[of_box[2]], -0.75);
  EXPECT_EQ(c.normal[of_box[2]].y, -1.0);
  EXPECT_DOUBLE_EQ(c.lever_b[of_box[2]], -0.25);
}

TEST_F(Box2dGeometry, EveryCornerOfAPolygonIsRound) {
  b2Body* box = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  b2PolygonShape shape;
  shape.SetAsBox(2.0f, 1.0f);
  box->CreateFixture(&shape, 0.0f);
  for (const float x : {-1.0f, 1.0f}) {
    for (const float y : {-1.0f, 1.0f}) {
      AddDisk(&world_, {2.375f * x, 1.5f * y}, 0.5f);  // nearest to the upper or lower side
      AddDisk(&world_, {2.5f * x, 1.375f * y}, 0.5f);  // nearest to the left or right one
    }
  }
  const ContactTable c = Detect(&adapter_, 0.2);
  int corners = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c.a[i] != 0) continue;
    ++corners;
    EXPECT_DOUBLE_EQ(c.gap[i], 0.125);
    EXPECT_EQ(c.flat[i], 0);
    EXPECT_EQ(std::abs(c.site[i].x), 2.0);
    EXPECT_EQ(std::abs(c.site[i].y), 1.0);
  }
  EXPECT_EQ(corners, 8);
}

TEST_F(Box2dGeometry, TurnedAndMovedWall) {
  const auto angle = static_cast<float>(std::numbers::pi / 6.0);
  b2Body* wall = AddBody(&world_, b2_kinematicBody, {5.0f, -3.0f}, angle);
  AddEdge(wall, {-2.0f, 0.25f}, {2.0f, 0.25f});
  const double a = angle;
  ExactBody exact;
  exact.pose = Pose{5.0 + std::cos(a) * 1.0 - std::sin(a) * 1.5, -3.0 + std::sin(a) * 1.0 + std::cos(a) * 1.5, 0.0};
  adapter_.Assign(AddDisk(&world_, {0.0f, 0.0f}), 7, exact);
  const ContactTable c = Detect(&adapter_, 1.0);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c.gap[0], 0.25, 1e-14);
  EXPECT_NEAR(c.normal[0].x, std::sin(a), 1e-15);  // the disk has the smaller id only if the wall's is larger
  EXPECT_NEAR(std::hypot(c.normal[0].x, c.normal[0].y), 1.0, 1e-15);
  const Vec2 arm = c.arm_b[0].x != 0.0 ? c.arm_b[0] : c.arm_a[0];
  EXPECT_NEAR(arm.x, std::cos(a) * 1.0 - std::sin(a) * 0.25, 1e-14);
  EXPECT_NEAR(arm.y, std::sin(a) * 1.0 + std::cos(a) * 0.25, 1e-14);
}

TEST_F(Box2dGeometry, ClusterHasArmsAboutItsCentreOfMass) {
  b2Body* cluster = AddBody(&world_, b2_dynamicBody, {10.0f, 0.0f}, 0.5f);
  AddCircle(cluster, 1.0f, {4.0f, 0.0f});
  AddCircle(cluster, 1.0f, {6.0f, 0.0f});
  BodyTable bodies;
  Detect(&adapter_, 0.1, &bodies);
  EXPECT_NEAR(bodies.pose[0].x, 10.0 + 5.0 * std::cos(0.5), 1e-14);
  EXPECT_NEAR(bodies.pose[0].y, 5.0 * std::sin(0.5), 1e-14);
  EXPECT_NEAR(bodies.inertia[0], 2.0 * std::numbers::pi * (0.5 + 1.0), 2e-4) << "not about the origin, float of Box2D";
  EXPECT_DOUBLE_EQ(bodies.radius[0], 1.0);
  EXPECT_NEAR(bodies.bounding_radius[0], 2.0, 1e-6);
  AddDisk(&world_, {0.0f, 0.0f});
  adapter_.ReadBodies(&bodies);
  adapter_.SetPose(1, {bodies.pose[0].x + 3.0 * std::cos(0.5), bodies.pose[0].y + 3.0 * std::sin(0.5), 0.0});
  const ContactTable c = Detect(&adapter_, 0.1);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c.shape_a[0], 1);
  EXPECT_NEAR(c.arm_a[0].x, std::cos(0.5), 1e-6);
  EXPECT_NEAR(c.arm_a[0].y, std::sin(0.5), 1e-6);
  EXPECT_NEAR(c.lever_a[0] + c.lever_b[0], 2.0, 1e-6);
}

TEST_F(Box2dGeometry, ExactHalfPlaneStandsForAnEdge) {
  b2Body* ground = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  AddEdge(ground, {-100.0f, 0.0f}, {100.0f, 0.0f});
  ExactBody exact;
  exact.shapes = {{HalfPlaneGeometry{{0.0, 1.0}, 1e-9}, 0.3, 0.1}};
  adapter_.Assign(ground, 4, exact);
  AddDisk(&world_, {5.0f, 1.0f})->GetFixtureList()->SetFriction(0.3f);
  AddDisk(&world_, {500.0f, -9.0f});  // beyond the edge, below the surface
  BodyTable bodies;
  const ContactTable c = Detect(&adapter_, 0.1, &bodies);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(bodies.bounding_radius[0], std::numeric_limits<double>::infinity());
  EXPECT_NEAR(c.gap[0], -1e-9, 2e-16);
  EXPECT_NEAR(c.gap[1], -10.0 - 1e-9, 1e-14);
  EXPECT_EQ(c.flat[0], 1);
  EXPECT_DOUBLE_EQ(c.friction[0], std::sqrt(0.3 * static_cast<double>(0.3f)));
  EXPECT_DOUBLE_EQ(c.restitution[0], 0.1);
}

TEST_F(Box2dGeometry, SensorsTouchNothingAndKeepTheirNumber) {
  b2Body* body = AddBody(&world_, b2_dynamicBody, {0.0f, 0.0f});
  AddCircle(body, 3.0f)->SetSensor(true);
  b2PolygonShape box;
  box.SetAsBox(5.0f, 5.0f);
  body->CreateFixture(&box, 0.0f)->SetSensor(true);
  AddCircle(body, 1.0f);
  AddDisk(&world_, {2.0f, 0.0f});
  BodyTable bodies;
  const ContactTable c = Detect(&adapter_, 0.1, &bodies);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c.shape_a[0], 2);
  EXPECT_EQ(bodies.radius[0], 1.0);
}

TEST_F(Box2dGeometry, SiteOfADeepDiskIsItsCentre) {
  b2Body* box = AddBody(&world_, b2_staticBody, {0.0f, -10.0f});
  b2PolygonShape shape;
  shape.SetAsBox(10.0f, 10.0f);
  box->CreateFixture(&shape, 0.0f);
  AddDisk(&world_, {2.0f, -4.0f}, 0.5f);
  AddDisk(&world_, {5.0f, 0.25f}, 0.5f);
  Box2dAdapter adapter(&world_);
  const ContactTable c = Detect(&adapter, 0.1);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(c.gap[0], -4.5);
  EXPECT_EQ(c.site[0].y, -4.0);
  EXPECT_NEAR(c.site[1].y, 0.0, 1e-6);
}

// An exact shape stands for its fixture until the fixture changes; whether the body is enabled, and its type, are not of the
// fixture.
TEST_F(Box2dGeometry, ExactShapesOutliveSetEnabledAndSetType) {
  b2Body* floor = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  b2Fixture* edge = AddEdge(floor, {-1.0f, 0.0f}, {1.0f, 0.0f});
  AddDisk(&world_, {5.0f, 0.5f}, 0.5f);
  Box2dAdapter adapter(&world_);
  ExactBody exact;
  exact.shapes.push_back({HalfPlaneGeometry{{0.0, 1.0}, 0.0}, {}, {}});
  adapter.Assign(floor, 0, exact);
  EXPECT_EQ(Detect(&adapter, 0.1).size(), 1u);
  floor->SetEnabled(false);
  EXPECT_EQ(Detect(&adapter, 0.1).size(), 0u);
  floor->SetEnabled(true);
  EXPECT_EQ(Detect(&adapter, 0.1).size(), 1u);
  floor->SetType(b2_kinematicBody);
  EXPECT_EQ(Detect(&adapter, 0.1).size(), 1u);
  edge->SetFriction(0.9f);
  EXPECT_EQ(Detect(&adapter, 0.1).size(), 0u) << "the fixture has changed";
}

}  // namespace
}  // namespace nscdd::box2d
