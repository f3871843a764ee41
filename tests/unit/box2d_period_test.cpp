// SPDX-License-Identifier: Apache-2.0
// The periodic direction of the Box2D adapter, which Box2D itself does not have.
#include <gtest/gtest.h>

#include "box2d_support.h"

namespace nscdd::box2d {
namespace {

class Box2dPeriod : public testing::Test {
 protected:
  Box2dPeriod() { options_.period = 10.0; }
  b2World world_{{0.0f, 0.0f}};
  Box2dOptions options_;
};

TEST_F(Box2dPeriod, PairAcrossTheBoundaryHasAnImage) {
  AddDisk(&world_, {9.5f, 0.0f});
  AddDisk(&world_, {1.25f, 0.0f});
  Box2dAdapter adapter(&world_, options_);
  const ContactTable c = Detect(&adapter, 0.0);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c.image[0], 1) << "B is seen at 11.25";
  EXPECT_DOUBLE_EQ(c.gap[0], -0.25);
  EXPECT_EQ(c.normal[0].x, 1.0);
  EXPECT_DOUBLE_EQ(c.site[0].x, 10.375);
}

TEST_F(Box2dPeriod, DiskTouchesTwoImagesOfAnother) {
  AddDisk(&world_, {0.0f, 0.0f}, 2.5f);
  AddDisk(&world_, {5.0f, 0.0f}, 2.5f);
  Box2dAdapter adapter(&world_, options_);
  const ContactTable c = Detect(&adapter, 0.0);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(c.image[0], -1);
  EXPECT_EQ(c.image[1], 0);
}

TEST_F(Box2dPeriod, FloorOfOnePeriodHasNoSeam) {
  AddEdge(AddBody(&world_, b2_staticBody, {0.0f, 0.0f}), {0.0f, 0.0f}, {10.0f, 0.0f});
  AddDisk(&world_, {0.0f, 1.0f});
  Box2dAdapter adapter(&world_, options_);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  for (int i = -300; i < 300; ++i) {
    std::vector<Pose> poses = bodies.pose;
    poses[1].x = 0.01 * i;
    ContactTable c;
    adapter.DetectContacts({bodies.id, poses}, 0.1, &c);
    ASSERT_EQ(c.size(), 1u) << poses[1].x;
    EXPECT_EQ(c.normal[0].y, 1.0) << poses[1].x;
    EXPECT_NEAR(c.gap[0], 0.0, 1e-15);
  }
}

TEST_F(Box2dPeriod, CentresAreKeptInThePeriod) {
  b2Body* body = AddDisk(&world_, {12.5f, 0.0f});
  Box2dAdapter adapter(&world_, options_);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  EXPECT_EQ(bodies.pose[0].x, 2.5);
  const Pose pose{-0.5, 0.0, 0.0};
  adapter.Commit({bodies.id, std::span(&pose, 1), bodies.velocity, {}, {}});
  EXPECT_EQ(body->GetPosition().x, 9.5f);
}

TEST_F(Box2dPeriod, TooShortIsRefused) {
  AddDisk(&world_, {0.0f, 0.0f}, 5.0f);
  Box2dAdapter adapter(&world_, options_);
  EXPECT_TRUE(Contains(Refusal([&] { Detect(&adapter, 0.1); }), "body 0 is 10 m wide and would touch its own image"));
}

TEST_F(Box2dPeriod, WallsLongerThanThePeriodAreRefused) {
  AddEdge(AddBody(&world_, b2_staticBody, {0.0f, 0.0f}), {-1.0f, 0.0f}, {10.0f, 0.0f});
  Box2dAdapter adapter(&world_, options_);
  EXPECT_TRUE(Contains(Refusal([&] { Detect(&adapter, 0.1); }), "body 0 is 11 m long in x"));
}

}  // namespace
}  // namespace nscdd::box2d
