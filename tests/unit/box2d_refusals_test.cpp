// SPDX-License-Identifier: Apache-2.0
// What the Box2D adapter refuses, and that its sentences say whom and why.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "box2d_support.h"

namespace nscdd::box2d {
namespace {

TEST(Box2dRefusals, WrongExactShapes) {
  b2World world({0.0f, -10.0f});
  Box2dAdapter adapter(&world);
  b2Body* body = AddDisk(&world, {0.0f, 0.0f});
  const auto assign = [&](ExactShape shape) { return Refusal([&] { adapter.Assign(body, 3, {{}, {}, {}, {}, {shape}}); }); };
  EXPECT_TRUE(Contains(assign({DiskGeometry{{}, 1.1}, {}, {}}), "radius 1.1 m and its fixture 1 m"));
  EXPECT_TRUE(Contains(assign({DiskGeometry{{0.1, 0.0}, 1.0}, {}, {}}), "its centre at (0.1, 0)"));
  EXPECT_TRUE(Contains(assign({SegmentGeometry{{0.0, 0.0}, {1.0, 0.0}}, {}, {}}), "another kind"));
  EXPECT_TRUE(Contains(Refusal([&] {
                         adapter.Assign(body, 3, {{}, {}, {}, {}, std::vector<ExactShape>(2)});
                       }),
                       "2 exact shapes"));
  EXPECT_EQ(adapter.Find(3), nullptr);
}

TEST(Box2dRefusals, WhatIsNotModelled) {
  const auto refusal = [&](auto edit) {
    b2World world({0.0f, 0.0f});
    Box2dAdapter adapter(&world);
    AddDisk(&world, {9.0f, 9.0f});
    b2Body* body = AddDisk(&world, {0.0f, 0.0f});
    edit(body);
    return Refusal([&] {
      BodyTable bodies;
      adapter.ReadBodies(&bodies);
    });
  };
  EXPECT_EQ(refusal([](b2Body*) {}), "");
  EXPECT_TRUE(Contains(refusal([](b2Body* b) { b->SetFixedRotation(true); }), "body 1 has fixed rotation"));
  EXPECT_TRUE(Contains(refusal([](b2Body* b) { b->SetLinearDamping(0.1f); }), "body 1 has linear damping 0.1"));
  EXPECT_TRUE(Contains(refusal([](b2Body* b) { b->SetAngularDamping(0.1f); }), "angular damping 0.1"));
  EXPECT_TRUE(Contains(refusal([](b2Body* b) {
                         AddEdge(b, {0.0f, 0.0f}, {1.0f, 0.0f});
                       }),
                       "body 1 is dynamic and has an edge"));
  EXPECT_TRUE(Contains(refusal([](b2Body* b) {
                         b->DestroyFixture(b->GetFixtureList());
                         AddCircle(b, 1.0f, {0.0f, 0.0f}, 0.0f);
                       }),
                       "body 1 is dynamic with mass"));
  EXPECT_TRUE(Contains(refusal([](b2Body* b) {
                         b->SetTransform({std::numeric_limits<float>::quiet_NaN(), 0.0f}, 0.0f);
                       }),
                       "give it finite numbers"));
  EXPECT_TRUE(Contains(refusal([](b2Body* b) {
                         b2DistanceJointDef joint;
                         joint.Initialize(b, b->GetNext(), {0.0f, 0.0f}, {9.0f, 9.0f});
                         b->GetWorld()->CreateJoint(&joint);
                       }),
                       "joint connects bodies 1 and 0"));
}

TEST(Box2dRefusals, OptionsWithoutMeaning) {
  b2World world({0.0f, 0.0f});
  const auto refusal = [&](auto edit) {
    Box2dOptions options;
    edit(&options);
    return Refusal([&] { Box2dAdapter adapter(&world, options); });
  };
  EXPECT_TRUE(Contains(refusal([](Box2dOptions* o) { o->metres_per_unit = 0.0; }), "metres_per_unit = 0"));
  EXPECT_TRUE(Contains(refusal([](Box2dOptions* o) { o->period = -1.0; }), "period = -1"));
  EXPECT_TRUE(Contains(Refusal([] { Box2dAdapter adapter(nullptr); }), "without a b2World"));
}

TEST(Box2dRefusals, CommitIsAllOrNothing) {
  b2World world({0.0f, -10.0f});
  Box2dAdapter adapter(&world);
  b2Body* body = AddDisk(&world, {0.0f, 0.0f});
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  const std::int64_t ids[] = {0, 4};
  const Pose poses[] = {{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  const Twist velocities[2] = {};
  EXPECT_TRUE(Contains(Refusal([&] { adapter.Commit({ids, poses, velocities, {}, {}}); }), "Commit names body 4"));
  EXPECT_EQ(body->GetPosition().x, 0.0f);
  EXPECT_TRUE(Contains(Refusal([&] {
                         const Pose nowhere{std::nan(""), 0.0, 0.0};
                         adapter.Commit({bodies.id, std::span(&nowhere, 1), bodies.velocity, {}, {}});
                       }),
                       "must be finite"));
}

}  // namespace
}  // namespace nscdd::box2d
