// SPDX-License-Identifier: Apache-2.0
// The b2World beside our steps: transport of bodies, silence of its own contacts, and coming back to its own Step.
#include <gtest/gtest.h>

#include <cmath>

#include "box2d_support.h"

namespace nscdd::box2d {
namespace {

std::vector<std::byte> Packed(Box2dAdapter* adapter, std::int64_t id) {
  std::vector<std::byte> bytes;
  adapter->transport()->Pack(id, &bytes);
  return bytes;
}

void Fill(b2World* world, Box2dAdapter* adapter) {
  ExactBody exact{Pose{1.1, 2.2, 0.3}, Twist{0.1, -0.2, 0.7}, {}, {}, {{DiskGeometry{{}, 0.7}, 0.3, 0.1}}};
  b2Body* disk = AddDisk(world, {1.1f, 2.2f}, 0.7f);
  disk->SetGravityScale(0.5f);
  adapter->Assign(disk, 11, exact);
  b2Body* cluster = AddBody(world, b2_dynamicBody, {2.5f, 3.0f}, 0.4f);
  AddCircle(cluster, 0.5f, {0.1f, 0.0f});
  AddCircle(cluster, 0.4f, {0.6f, 0.2f})->SetFriction(0.9f);
  AddCircle(cluster, 2.0f)->SetSensor(true);
  adapter->Assign(cluster, 12);
  b2Body* walls = AddBody(world, b2_kinematicBody, {0.0f, 1.0f}, 0.1f);
  const b2Vec2 points[] = {{-3.0f, 1.0f}, {0.0f, 0.3f}, {3.0f, 1.0f}};
  b2ChainShape chain;
  chain.CreateChain(points, 3, {-4.0f, 2.0f}, {4.0f, 2.0f});
  walls->CreateFixture(&chain, 0.0f);
  b2PolygonShape box;
  box.SetAsBox(0.5f, 0.25f, {3.0f, 1.2f}, 0.3f);
  walls->CreateFixture(&box, 0.0f);
  AddEdge(walls, {-3.0f, 1.0f}, {-3.0f, 4.0f});
  walls->SetAngularVelocity(0.25f);
  adapter->Assign(walls, 3);
}

void ExpectSameTables(Box2dAdapter* one, Box2dAdapter* other) {
  BodyTable p, q;
  const ContactTable a = Detect(one, 0.8, &p), b = Detect(other, 0.8, &q);
  ASSERT_EQ(p.id, q.id);
  EXPECT_EQ(p.kind, q.kind);
  EXPECT_EQ(p.mass, q.mass);
  EXPECT_EQ(p.inertia, q.inertia);
  EXPECT_EQ(p.bounding_radius, q.bounding_radius);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p.pose[i].x, q.pose[i].x);
    EXPECT_EQ(p.pose[i].angle, q.pose[i].angle);
    EXPECT_EQ(p.velocity[i].spin, q.velocity[i].spin);
    EXPECT_EQ(p.force[i].fx, q.force[i].fx);
    EXPECT_EQ(p.force[i].fy, q.force[i].fy);
    EXPECT_EQ(p.force[i].torque, q.force[i].torque);
  }
  ASSERT_GE(a.size(), 4u);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.shape_a, b.shape_a);
  EXPECT_EQ(a.shape_b, b.shape_b);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.restitution, b.restitution);
  EXPECT_EQ(a.lever_b, b.lever_b);
}

TEST(Box2dTransport, BodiesTravelBitwise) {
  b2World here({0.0f, -10.0f}), there({0.0f, -10.0f});
  Box2dAdapter one(&here), other(&there);
  Fill(&here, &one);
  one.Find(11)->ApplyForce({1.0f, 2.0f}, {1.5f, 2.0f}, true);
  one.AddLoad(12, {0.1, 0.2, 0.3});
  for (const std::int64_t id : {12, 3, 11}) other.transport()->Insert(id, Packed(&one, id));
  EXPECT_EQ(there.GetBodyCount(), 3);
  ExpectSameTables(&one, &other);
  const b2Body *sent = one.Find(12), *got = other.Find(12);
  EXPECT_EQ(sent->GetPosition(), got->GetPosition());
  EXPECT_EQ(sent->GetMass(), got->GetMass());
  EXPECT_TRUE(got->GetFixtureList()->IsSensor());
}

TEST(Box2dTransport, ThereAndBackAndAgain) {
  b2World here({0.0f, -10.0f}), there({0.0f, -10.0f}), still({0.0f, -10.0f});
  Box2dAdapter one(&here), other(&there), untouched(&still);
  Fill(&here, &one);
  Fill(&still, &untouched);
  for (int round = 0; round < 3; ++round) {
    for (const std::int64_t id : {11, 3, 12}) {
      other.transport()->Insert(id, Packed(&one, id));
      one.transport()->Remove(id);
    }
    EXPECT_EQ(here.GetBodyCount(), 0);
    for (const std::int64_t id : {3, 12, 11}) {
      one.transport()->Insert(id, Packed(&other, id));
      other.transport()->Remove(id);
    }
    ExpectSameTables(&one, &untouched);
  }
}

TEST(Box2dTransport, RefusalsSpeak) {
  b2World here({0.0f, -10.0f});
  Box2dAdapter one(&here);
  Fill(&here, &one);
  std::vector<std::byte> bytes = Packed(&one, 11);
  EXPECT_TRUE(Contains(Refusal([&] { one.transport()->Insert(11, bytes); }), "holds it already"));
  EXPECT_TRUE(Contains(Refusal([&] { one.transport()->Insert(99, bytes); }), "of another body"));
  EXPECT_TRUE(Contains(Refusal([&] { one.transport()->Remove(99); }), "Remove names body 99"));
  EXPECT_TRUE(Contains(Refusal([&] { Packed(&one, 99); }), "Pack names body 99"));
  one.transport()->Remove(11);
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_TRUE(Contains(Refusal([&] { one.transport()->Insert(11, std::span(bytes).first(size)); }), "end too early")) << size;
  }
  bytes.push_back(std::byte{0});
  EXPECT_TRUE(Contains(Refusal([&] { one.transport()->Insert(11, bytes); }), "behind the end"));
  bytes.pop_back();
  bytes[0] ^= std::byte{1};
  EXPECT_TRUE(Contains(Refusal([&] { one.transport()->Insert(11, bytes); }), "another kind or version"));
  EXPECT_EQ(here.GetBodyCount(), 2);
}

/// Counts every call of Box2D.
struct Listener final : b2ContactListener {
  void BeginContact(b2Contact*) override { ++calls; }
  void EndContact(b2Contact*) override { ++calls; }
  void PreSolve(b2Contact*, const b2Manifold*) override { ++calls; }
  void PostSolve(b2Contact*, const b2ContactImpulse*) override { ++calls; }
  int calls = 0;
};

/// Two overlapping disks; a jump of both is so long a path that the world's notes of moves are emptied at once.
class Box2dMoves : public testing::Test {
 protected:
  Box2dMoves() {
    a_ = AddDisk(&world_, {0.0f, 0.0f});
    AddDisk(&world_, {1.5f, 0.0f});
    world_.SetContactListener(&listener_);
    adapter_.ReadBodies(&bodies_);
  }
  void Jump(double x, double distance = 1.5) {
    const Pose poses[] = {{x, 0.0, 0.0}, {x + distance, 0.0, 0.0}};
    adapter_.Commit({bodies_.id, poses, bodies_.velocity, {}, {}});
  }
  b2World world_{{0.0f, 0.0f}};
  Listener listener_;
  Box2dAdapter adapter_{&world_};
  BodyTable bodies_;
  b2Body* a_ = nullptr;
};

TEST_F(Box2dMoves, MakeNoContactsAndNoNoise) {
  for (int k = 1; k <= 100; ++k) Jump(1e4 * (k % 2));
  EXPECT_EQ(world_.GetContactCount(), 0);
  EXPECT_EQ(listener_.calls, 0);
  EXPECT_EQ(world_.GetContactManager().m_contactListener, &listener_);
}

TEST_F(Box2dMoves, EndOldContactsSilently) {
  world_.Step(0.001f, 8, 3);
  ASSERT_EQ(world_.GetContactCount(), 1);
  const int calls = listener_.calls;
  adapter_.ReadBodies(&bodies_);
  Jump(1e4, 50.0);
  EXPECT_EQ(world_.GetContactCount(), 0);
  EXPECT_EQ(listener_.calls, calls);
}

TEST_F(Box2dMoves, KeepLoads) {
  a_->ApplyForceToCenter({1.0f, 0.0f}, true);  // after ReadBodies: meant for the next step
  Jump(1e4);
  adapter_.ReadBodies(&bodies_);
  EXPECT_EQ(bodies_.force[0].fx, 1.0);
  EXPECT_TRUE(world_.GetAutoClearForces());
}

TEST_F(Box2dMoves, AreForgottenByTheWorldUntilItIsRefreshed) {
  Jump(1e4);
  world_.Step(0.001f, 8, 3);
  ASSERT_EQ(world_.GetContactCount(), 0) << "the notes were emptied";
  adapter_.RefreshWorldContacts();
  world_.Step(0.001f, 8, 3);
  EXPECT_EQ(world_.GetContactCount(), 1);
  EXPECT_GT(listener_.calls, 0) << "found before the step, not at its end";
}

TEST_F(Box2dMoves, OfTurningHalfPlanesAreCounted) {
  b2Body* walls = AddBody(&world_, b2_kinematicBody, {0.0f, -90.0f});
  AddEdge(walls, {-9.0f, 0.0f}, {9.0f, 0.0f});
  AddEdge(walls, {0.0f, -9.0f}, {0.0f, 9.0f});
  adapter_.Assign(
      walls, 7, {{}, {}, {}, {}, {{HalfPlaneGeometry{{0.0, 1.0}, 0.0}, {}, {}}, {HalfPlaneGeometry{{1.0, 0.0}, 0.0}, {}, {}}}});
  adapter_.ReadBodies(&bodies_);
  adapter_.Commit({bodies_.id, bodies_.pose, bodies_.velocity, {}, {}});  // nothing moved, so nothing is emptied
  world_.Step(0.001f, 8, 3);
  EXPECT_EQ(world_.GetContactCount(), 1);
}

TEST(Box2dWorld, OwnStepsAreAdopted) {
  b2World world({0.0f, -10.0f});
  b2Body* body = AddDisk(&world, {0.0f, 0.0f});
  Box2dAdapter adapter(&world);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  world.Step(0.5f, 8, 3);
  adapter.ReadBodies(&bodies);
  EXPECT_EQ(bodies.velocity[0].vy, static_cast<double>(body->GetLinearVelocity().y));
  EXPECT_EQ(bodies.pose[0].y, static_cast<double>(body->GetPosition().y));
  EXPECT_LT(bodies.pose[0].y, 0.0);
}

TEST(Box2dWorld, ImpulseListenerHearsActiveContacts) {
  b2World world({0.0f, -10.0f});
  b2Body* a = AddDisk(&world, {0.0f, 0.0f});
  b2Body* b = AddDisk(&world, {2.0f, 0.0f});
  std::vector<ContactImpulse> heard;
  Box2dOptions options;
  options.impulse_listener = [&heard](const ContactImpulse& impulse) { heard.push_back(impulse); };
  Box2dAdapter adapter(&world, options);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  const ContactKey keys[] = {{0, 1, 0, 0, 0}, {0, 1, 0, 0, 1}};
  const Vec2 impulses[] = {{0.5, 0.1}, {0.0, 0.0}};
  adapter.Commit({bodies.id, bodies.pose, bodies.velocity, keys, impulses});
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0].fixture_a, a->GetFixtureList());
  EXPECT_EQ(heard[0].fixture_b, b->GetFixtureList());
  EXPECT_EQ(heard[0].impulse.x, 0.5);
}

TEST(Box2dWorld, LockedWorldIsRefused) {
  struct Caller final : b2ContactListener {
    void BeginContact(b2Contact*) override {
      sentence = Refusal([this] {
        BodyTable bodies;
        adapter->ReadBodies(&bodies);
      });
    }
    Box2dAdapter* adapter = nullptr;
    std::string sentence;
  } caller;
  b2World world({0.0f, 0.0f});
  Box2dAdapter adapter(&world);
  caller.adapter = &adapter;
  world.SetContactListener(&caller);
  AddDisk(&world, {0.0f, 0.0f});
  AddDisk(&world, {1.0f, 0.0f});
  world.Step(0.01f, 8, 3);
  EXPECT_TRUE(Contains(caller.sentence, "the b2World is locked") || Contains(caller.sentence, "The b2World is locked"));
}

TEST(Box2dWorld, TwoAdaptersShareAWorld) {
  b2World world({0.0f, -10.0f});
  AddDisk(&world, {0.0f, 0.0f});
  Box2dAdapter one(&world), other(&world);
  BodyTable bodies;
  other.ReadBodies(&bodies);
  one.ReadBodies(&bodies);
  bodies.pose[0].x = 3.3;
  one.Commit({bodies.id, bodies.pose, bodies.velocity, {}, {}});
  other.ReadBodies(&bodies);
  EXPECT_EQ(bodies.pose[0].x, static_cast<double>(3.3f)) << "what one writes is an edit to the other";
}

TEST(Box2dLoads, ActOnceAlsoOnABodyThatWasDisabled) {
  b2World world({0.0f, 0.0f});
  b2Body* disk = AddDisk(&world, {0.0f, 0.0f});
  AddDisk(&world, {5.0f, 0.0f});
  Box2dAdapter adapter(&world);
  BodyTable bodies;
  const auto step = [&] {
    adapter.ReadBodies(&bodies);
    adapter.Commit({bodies.id, bodies.pose, bodies.velocity, {}, {}});
  };
  step();
  disk->SetEnabled(false);
  adapter.AddLoad(0, {1.0, 0.0, 0.0});
  step();
  disk->SetEnabled(true);
  step();
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies.force[0].fx, 0.0);
}

TEST(Box2dWorld, DestroyedBodiesAreForgottenAtOnce) {
  b2World world({0.0f, 0.0f});
  b2Body* gone = AddDisk(&world, {0.0f, 0.0f});
  AddDisk(&world, {5.0f, 0.0f});
  Box2dAdapter adapter(&world);
  Detect(&adapter, 0.1);
  world.DestroyBody(gone);
  EXPECT_EQ(adapter.Find(0), nullptr);
  EXPECT_TRUE(Contains(Refusal([&] { adapter.SetPose(0, {1.0, 2.0, 0.0}); }), "body 0"));
  AddDisk(&world, {9.0f, 0.0f});  // perhaps in the memory of the one before
  EXPECT_EQ(adapter.Find(0), nullptr);
  EXPECT_NE(adapter.Find(1), nullptr);
}

TEST(Box2dTransport, JointsDoNotTravel) {
  b2World world({0.0f, 0.0f});
  b2Body *one = AddDisk(&world, {0.0f, 0.0f}), *other = AddDisk(&world, {3.0f, 0.0f});
  b2DistanceJointDef def;
  def.Initialize(one, other, {0.0f, 0.0f}, {3.0f, 0.0f});
  world.CreateJoint(&def);
  Box2dOptions options;
  options.joints_only_filter = true;
  Box2dAdapter adapter(&world, options);
  Detect(&adapter, 0.1);
  EXPECT_TRUE(Contains(Refusal([&] { Packed(&adapter, 0); }), "Body 0 has a joint"));
}

TEST(Box2dWorld, StaticBodiesAreNotAssignedAVelocity) {
  b2World world({0.0f, 0.0f});
  Box2dAdapter adapter(&world);
  b2Body* wall = AddBody(&world, b2_staticBody, {0.0f, 0.0f});
  const ExactBody exact{{}, Twist{1.0, 0.0, 0.0}, {}, {}, {}};
  EXPECT_TRUE(Contains(Refusal([&] { adapter.Assign(wall, 3, exact); }), "body 3 is static"));
  adapter.Assign(wall, 3);
  EXPECT_TRUE(Contains(Refusal([&] { adapter.Assign(AddDisk(&world, {5.0f, 0.0f}), INT64_MAX); }), "2^63 - 1"));
}

}  // namespace
}  // namespace nscdd::box2d
