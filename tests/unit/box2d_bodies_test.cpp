// SPDX-License-Identifier: Apache-2.0
// Ids, edits, loads, units and refusals of the Box2D adapter.
#include <gtest/gtest.h>

#include <cmath>

#include "box2d_support.h"

namespace nscdd::box2d {
namespace {

class Box2dBodies : public testing::Test {
 protected:
  BodyTable Read() {
    BodyTable bodies;
    adapter_.ReadBodies(&bodies);
    return bodies;
  }
  void Commit(std::int64_t id, Pose pose, Twist velocity) {
    adapter_.Commit({std::span(&id, 1), std::span(&pose, 1), std::span(&velocity, 1), {}, {}});
  }
  b2World world_{{0.0f, -10.0f}};
  Box2dAdapter adapter_{&world_};
};

TEST_F(Box2dBodies, IdsFollowTheOrderOfCreation) {
  std::vector<b2Body*> made;
  for (int i = 0; i < 4; ++i) made.push_back(AddDisk(&world_, {3.0f * i, 0.0f}));
  EXPECT_EQ(Read().id, (std::vector<std::int64_t>{0, 1, 2, 3}));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(adapter_.Find(i), made[static_cast<std::size_t>(i)]);
  EXPECT_EQ(adapter_.IdOf(made[2]), 2);
  EXPECT_EQ(adapter_.Find(9), nullptr);
}

TEST_F(Box2dBodies, IdsSurviveRemovalAndAreNotGivenTwice) {
  std::vector<b2Body*> made;
  for (int i = 0; i < 4; ++i) made.push_back(AddDisk(&world_, {3.0f * i, 0.0f}));
  Read();
  world_.DestroyBody(made[1]);
  b2Body* again = AddDisk(&world_, {50.0f, 0.0f});  // Box2D reuses the address
  EXPECT_EQ(again, made[1]) << "the test's premise";
  EXPECT_EQ(Read().id, (std::vector<std::int64_t>{0, 2, 3, 4}));
  EXPECT_EQ(adapter_.Find(4), again);
  EXPECT_EQ(adapter_.Find(1), nullptr);
}

TEST_F(Box2dBodies, AssignedIdsWin) {
  b2Body* a = AddDisk(&world_, {0.0f, 0.0f});
  b2Body* b = AddDisk(&world_, {3.0f, 0.0f});
  AddDisk(&world_, {6.0f, 0.0f});
  adapter_.Assign(b, 5);
  adapter_.Assign(AddDisk(&world_, {20.0f, 0.0f}), 2);
  EXPECT_EQ(Read().id, (std::vector<std::int64_t>{2, 5, 6, 7}));
  EXPECT_EQ(adapter_.Find(5), b);
  EXPECT_EQ(adapter_.Find(6), a);
  EXPECT_TRUE(Contains(Refusal([&] { adapter_.Assign(a, 8); }), "has id 6 already"));
  EXPECT_TRUE(Contains(Refusal([&] { adapter_.Assign(AddDisk(&world_, {9.0f, 0.0f}), 5); }), "id 5, which another body has"));
  EXPECT_TRUE(Contains(Refusal([&] { adapter_.Assign(AddDisk(&world_, {9.0f, 0.0f}), -1); }), "negative"));
}

TEST_F(Box2dBodies, AddressOfADestroyedBodyMayBeAssignedAnew) {
  b2Body* old = AddDisk(&world_, {0.0f, 0.0f});
  AddDisk(&world_, {3.0f, 0.0f});
  Read();
  world_.DestroyBody(old);
  b2Body* again = AddDisk(&world_, {6.0f, 0.0f});
  ASSERT_EQ(again, old) << "the test's premise";
  adapter_.Assign(again, 40);
  EXPECT_EQ(Read().id, (std::vector<std::int64_t>{1, 40}));
  world_.DestroyBody(again);
  b2Body* third = AddDisk(&world_, {9.0f, 0.0f});
  EXPECT_EQ(Read().size(), 2u) << "undetectable: the newest body destroyed, another made at its address";
  EXPECT_EQ(adapter_.IdOf(third), 40);
}

TEST_F(Box2dBodies, DoublePrecisionSurvivesUntilTheUserEdits) {
  b2Body* body = AddDisk(&world_, {0.0f, 0.0f});
  Read();
  const Pose pose{1.1, 2.2, 0.3};
  const Twist velocity{0.1, 0.2, 0.7};
  Commit(0, pose, velocity);
  EXPECT_EQ(body->GetPosition().x, 1.1f);
  EXPECT_EQ(body->GetAngle(), 0.3f);
  EXPECT_EQ(body->GetAngularVelocity(), 0.7f);
  BodyTable bodies = Read();
  EXPECT_EQ(bodies.pose[0].x, 1.1);
  EXPECT_EQ(bodies.pose[0].angle, 0.3);
  EXPECT_EQ(bodies.velocity[0].vx, 0.1);

  body->ApplyLinearImpulseToCenter({body->GetMass(), 0.0f}, true);
  bodies = Read();
  EXPECT_EQ(bodies.velocity[0].vx, static_cast<double>(1.1f));
  EXPECT_EQ(bodies.pose[0].x, 1.1) << "the pose was not edited";
  body->SetTransform(body->GetPosition(), 1.0f);
  bodies = Read();
  EXPECT_EQ(bodies.pose[0].x, 1.1) << "only the angle was edited";
  EXPECT_EQ(bodies.pose[0].angle, 1.0);
  body->SetTransform({7.0f, 8.0f}, 1.0f);
  bodies = Read();
  EXPECT_EQ(bodies.pose[0].x, 7.0);
  EXPECT_EQ(bodies.velocity[0].vy, 0.2) << "only vx was edited";
}

TEST_F(Box2dBodies, ClusterCommitsItsOrigin) {
  b2Body* body = AddBody(&world_, b2_dynamicBody, {0.0f, 0.0f});
  AddCircle(body, 1.0f, {2.0f, 0.0f});
  AddCircle(body, 1.0f, {4.0f, 0.0f});
  Read();
  Commit(0, {10.0, 20.0, 1.0}, {});
  EXPECT_NEAR(body->GetWorldCenter().x, 10.0, 1e-5);
  EXPECT_NEAR(body->GetWorldCenter().y, 20.0, 1e-5);
  EXPECT_NEAR(body->GetPosition().x, 10.0 - 3.0 * std::cos(1.0), 1e-5);
  EXPECT_EQ(Read().pose[0].x, 10.0);
}

TEST_F(Box2dBodies, ChangedFixturesAreRead) {
  b2Body* body = AddDisk(&world_, {0.0f, 0.0f});
  AddDisk(&world_, {2.5f, 0.0f});
  EXPECT_EQ(Detect(&adapter_, 0.0).size(), 0u);
  b2Fixture* extra = AddCircle(body, 1.0f, {1.0f, 0.0f});
  BodyTable bodies;
  EXPECT_EQ(Detect(&adapter_, 0.0, &bodies).size(), 1u);
  EXPECT_NEAR(bodies.pose[0].x, 0.5, 1e-7);
  EXPECT_NEAR(bodies.mass[0], 2.0 * b2_pi, 1e-5);
  extra->SetFriction(0.8f);
  EXPECT_NEAR(Detect(&adapter_, 0.0).friction[0], 0.4, 1e-7);
  extra->SetSensor(true);
  EXPECT_EQ(Detect(&adapter_, 0.0).size(), 0u);
}

TEST_F(Box2dBodies, GravityAndNativeLoadsAct) {
  b2Body* body = AddDisk(&world_, {1.0f, 1.0f});
  body->SetGravityScale(0.5f);
  const double m = body->GetMass();
  EXPECT_DOUBLE_EQ(Read().force[0].fy, -5.0 * m);
  body->ApplyForceToCenter({3.0f, 0.0f}, true);
  body->ApplyForce({0.0f, 2.0f}, {2.0f, 1.0f}, true);
  body->ApplyTorque(0.5f, true);
  adapter_.AddLoad(0, {0.1, 0.0, 0.2});
  BodyTable bodies = Read();
  EXPECT_DOUBLE_EQ(bodies.force[0].fx, 3.1);
  EXPECT_DOUBLE_EQ(bodies.force[0].fy, 2.0 - 5.0 * m);
  EXPECT_DOUBLE_EQ(bodies.force[0].torque, 2.7);
  EXPECT_DOUBLE_EQ(Read().force[0].fx, 3.1) << "reading twice changes nothing";
  Commit(0, bodies.pose[0], bodies.velocity[0]);
  bodies = Read();
  EXPECT_EQ(bodies.force[0].fx, 0.0) << "loads last for one step";
  EXPECT_EQ(bodies.force[0].torque, 0.0);
}

TEST_F(Box2dBodies, LoadsStayWhenTheUserClearsThemHimself) {
  b2Body* body = AddDisk(&world_, {0.0f, 0.0f});
  world_.SetAutoClearForces(false);
  body->ApplyForceToCenter({3.0f, 0.0f}, true);
  const BodyTable bodies = Read();
  Commit(0, bodies.pose[0], bodies.velocity[0]);
  EXPECT_EQ(Read().force[0].fx, 3.0);
}

TEST_F(Box2dBodies, ExactGravityIsKeptUntilTheWorldsChanges) {
  AddDisk(&world_, {0.0f, 0.0f});
  adapter_.SetGravity({0.0, -9.81});
  EXPECT_EQ(world_.GetGravity().y, -9.81f);
  BodyTable bodies = Read();
  EXPECT_EQ(bodies.force[0].fy, bodies.mass[0] * -9.81);
  world_.SetGravity({1.0f, 0.0f});
  bodies = Read();
  EXPECT_EQ(bodies.force[0].fx, bodies.mass[0]);
  EXPECT_EQ(bodies.force[0].fy, 0.0);
}

TEST_F(Box2dBodies, ExactMassAndShapesAreUsed) {
  b2Body* body = AddDisk(&world_, {0.1f, 0.0f}, 0.1f);
  ExactBody exact{Pose{0.1, 0.2, 0.3}, Twist{0.4, 0.5, 0.6}, 0.7, 0.8, {{DiskGeometry{{}, 0.1}, 0.3, {}}}};
  adapter_.Assign(body, 3, exact);
  BodyTable bodies = Read();
  EXPECT_EQ(bodies.mass[0], 0.7);
  EXPECT_EQ(bodies.inertia[0], 0.8);
  EXPECT_EQ(bodies.radius[0], 0.1);
  EXPECT_EQ(bodies.pose[0].y, 0.2);
  EXPECT_EQ(bodies.velocity[0].spin, 0.6);
  EXPECT_EQ(body->GetMass(), 0.7f);
  EXPECT_EQ(body->GetPosition().y, 0.2f);
  body->GetFixtureList()->GetShape()->m_radius = 0.2f;
  bodies = Read();
  EXPECT_EQ(bodies.radius[0], static_cast<double>(0.2f)) << "the user's edit wins";
  EXPECT_EQ(bodies.mass[0], 0.7) << "the mass was not edited";
}

TEST_F(Box2dBodies, ExactPolygonMayBeginWithAnyVertex) {
  b2Body* body = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  b2PolygonShape shape;
  shape.SetAsBox(0.3f, 0.3f);
  body->CreateFixture(&shape, 0.0f);
  adapter_.Assign(body, 0, {{}, {}, {}, {}, {{PolygonGeometry{{{0.3, 0.3}, {-0.3, 0.3}, {-0.3, -0.3}, {0.3, -0.3}}}, {}, {}}}});
  AddDisk(&world_, {0.0f, 1.5f});
  EXPECT_EQ(Detect(&adapter_, 1.0).gap[0], 1.2 - 1.0) << "not the float's 0.3";
}

TEST(Box2dUnits, MetresPerUnitScalesAllButMass) {
  b2World world({0.0f, -1000.0f});
  Box2dOptions options;
  options.metres_per_unit = 0.01;
  Box2dAdapter adapter(&world, options);
  b2Body* body = AddDisk(&world, {100.0f, 50.0f});
  body->SetLinearVelocity({30.0f, 0.0f});
  body->SetAngularVelocity(2.0f);
  body->ApplyForceToCenter({7.0f, 0.0f}, true);
  body->ApplyTorque(9.0f, true);
  AddDisk(&world, {102.5f, 50.0f});
  BodyTable bodies;
  const ContactTable c = Detect(&adapter, 0.01, &bodies);
  const double m = body->GetMass();
  EXPECT_DOUBLE_EQ(bodies.mass[0], m);
  EXPECT_DOUBLE_EQ(bodies.inertia[0], static_cast<double>(body->GetInertia()) * 1e-4);
  EXPECT_DOUBLE_EQ(bodies.radius[0], 0.01);
  EXPECT_DOUBLE_EQ(bodies.pose[0].x, 1.0);
  EXPECT_DOUBLE_EQ(bodies.velocity[0].vx, 0.3);
  EXPECT_DOUBLE_EQ(bodies.velocity[0].spin, 2.0);
  EXPECT_DOUBLE_EQ(bodies.force[0].fx, 0.07);
  EXPECT_DOUBLE_EQ(bodies.force[0].fy, -10.0 * m);
  EXPECT_DOUBLE_EQ(bodies.force[0].torque, 9e-4);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c.gap[0], 0.005, 1e-16);
  const std::int64_t id = 0;
  const Pose pose{0.2, 0.3, 0.0};
  const Twist velocity{0.5, 0.0, 1.0};
  adapter.Commit({std::span(&id, 1), std::span(&pose, 1), std::span(&velocity, 1), {}, {}});
  EXPECT_FLOAT_EQ(body->GetPosition().x, 20.0f);
  EXPECT_FLOAT_EQ(body->GetLinearVelocity().x, 50.0f);
}

TEST_F(Box2dBodies, KindsAndPrescribedVelocities) {
  b2Body* fixed = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  AddEdge(fixed, {0.0f, 0.0f}, {1.0f, 0.0f});
  b2Body* drum = AddBody(&world_, b2_kinematicBody, {9.0f, 0.0f});
  AddCircle(drum, 1.0f);
  drum->SetAngularVelocity(0.25f);
  b2Body* off = AddDisk(&world_, {20.0f, 0.0f});
  off->SetEnabled(false);
  b2Body* free = AddDisk(&world_, {30.0f, 0.0f});
  free->SetAwake(false);
  BodyTable bodies = Read();
  EXPECT_EQ(bodies.id, (std::vector<std::int64_t>{0, 1, 3})) << "disabled bodies are left out";
  EXPECT_EQ(bodies.kind[0], BodyKind::kPrescribed);
  EXPECT_EQ(bodies.kind[1], BodyKind::kPrescribed);
  EXPECT_EQ(bodies.kind[2], BodyKind::kFree);
  EXPECT_EQ(bodies.velocity[1].spin, 0.25);
  EXPECT_EQ(bodies.radius[0], 0.0);
  off->SetEnabled(true);
  EXPECT_EQ(Read().size(), 4u);
  adapter_.SetVelocity(1, {0.1, 0.0, 0.3});
  EXPECT_EQ(Read().velocity[1].vx, 0.1);
  EXPECT_TRUE(Contains(Refusal([&] { adapter_.SetVelocity(0, {1.0, 0.0, 0.0}); }), "body 0 is static"));
  bodies = Read();
  Commit(3, bodies.pose[3], {0.0, -0.1, 0.0});
  EXPECT_TRUE(free->IsAwake());
}

}  // namespace
}  // namespace nscdd::box2d
