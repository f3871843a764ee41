// SPDX-License-Identifier: Apache-2.0
// Which pairs the Box2D adapter finds: complete against all pairs, filtered, periodic, whatever happened before.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "box2d_support.h"

namespace nscdd::box2d {
namespace {

using PairList = std::vector<std::tuple<std::int64_t, std::int64_t, std::int32_t>>;

/// All pairs of centred disks by definition; images from -6 to 6.
PairList AllPairs(const BodyTable& bodies, const std::vector<Pose>& poses, double alert, double period) {
  PairList pairs;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      if (bodies.kind[i] == BodyKind::kPrescribed && bodies.kind[j] == BodyKind::kPrescribed) continue;
      for (int image = period > 0.0 ? -6 : 0; image <= (period > 0.0 ? 6 : 0); ++image) {
        const double x = poses[j].x + image * period - poses[i].x, y = poses[j].y - poses[i].y;
        if (std::sqrt(x * x + y * y) - (bodies.radius[i] + bodies.radius[j]) > alert) continue;
        pairs.emplace_back(bodies.id[i], bodies.id[j], image);
      }
    }
  }
  return pairs;
}

PairList FoundPairs(const BodyTable& bodies, const ContactTable& c) {
  PairList pairs;
  for (std::size_t i = 0; i < c.size(); ++i) {
    pairs.emplace_back(bodies.id[static_cast<std::size_t>(c.a[i])], bodies.id[static_cast<std::size_t>(c.b[i])],
                       c.has_images() ? c.image[i] : 0);
  }
  return pairs;
}

void ExpectSame(const ContactTable& a, const ContactTable& b) {
  EXPECT_EQ(a.a, b.a);
  EXPECT_EQ(a.b, b.b);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.image, b.image);
  EXPECT_EQ(a.lever_a, b.lever_a);
}

class Box2dPairs : public testing::Test {
 protected:
  /// Disks of radii 0.3 to 1.5, one in ten of them static.
  void Fill(b2World* world, int count, double width, double height, Vec2 origin = {}) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < count; ++i) {
      b2Body* body = AddBody(
          world, i % 10 == 0 ? b2_staticBody : b2_dynamicBody,
          {static_cast<float>(origin.x + width * unit(random_)), static_cast<float>(origin.y + height * unit(random_))});
      AddCircle(body, static_cast<float>(0.3 + 1.2 * unit(random_)));
    }
  }
  /// Moves, detects and compares with all pairs again and again; the last table must be that of a new adapter.
  void Drift(b2World* world, const Box2dOptions& options, double step, int steps, double alert) {
    Box2dAdapter adapter(world, options);
    BodyTable bodies;
    adapter.ReadBodies(&bodies);
    std::vector<Pose> poses = bodies.pose;
    std::vector<Vec2> way(poses.size());
    std::normal_distribution<double> normal(0.0, step);
    for (Vec2& w : way) w = {normal(random_), normal(random_)};
    ContactTable contacts;
    for (int k = 0; k < steps; ++k) {
      for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = {poses[i].x + way[i].x, poses[i].y + way[i].y, 0.0};
      adapter.DetectContacts({bodies.id, poses}, alert, &contacts);
      ASSERT_EQ(FoundPairs(bodies, contacts), AllPairs(bodies, poses, alert, options.period)) << "step " << k;
    }
    ASSERT_GT(contacts.size(), 0u);
    Box2dAdapter other(world, options);
    ContactTable fresh;
    other.ReadBodies(&bodies);
    other.DetectContacts({bodies.id, poses}, alert, &fresh);
    ExpectSame(contacts, fresh);
  }
  std::mt19937 random_{7};
  b2World world_{{0.0f, 0.0f}};
};

TEST_F(Box2dPairs, CompleteUnderSlowDrift) {
  Fill(&world_, 300, 30.0, 30.0);
  Drift(&world_, {}, 0.003, 200, 0.05);
}

TEST_F(Box2dPairs, CompleteUnderFastMotionAndLargeAlert) {
  Fill(&world_, 300, 30.0, 30.0);
  Drift(&world_, {}, 0.7, 20, 1.0);
}

TEST_F(Box2dPairs, CompleteFarFromTheOrigin) {
  Fill(&world_, 200, 25.0, 25.0, {3e4, -1e6});
  Drift(&world_, {}, 0.01, 50, 0.02);
}

TEST_F(Box2dPairs, CompleteWhenPosesLeaveTheWorldBehind) {
  Fill(&world_, 200, 25.0, 25.0);
  Box2dAdapter adapter(&world_);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  for (const double away : {0.0, 1e5, 1e7, -3e9}) {
    std::vector<Pose> poses = bodies.pose;
    for (Pose& q : poses) q.x += away;
    ContactTable contacts;
    adapter.DetectContacts({bodies.id, poses}, 0.05, &contacts);
    EXPECT_EQ(FoundPairs(bodies, contacts), AllPairs(bodies, poses, 0.05, 0.0)) << away;
  }
}

TEST_F(Box2dPairs, CompleteWithTinyGrainsInALargeUnit) {
  for (int i = 0; i < 200; ++i) {
    std::uniform_real_distribution<float> unit(0.0f, 0.02f);
    AddDisk(&world_, {unit(random_), unit(random_)}, 0.0005f + 0.02f * unit(random_));
  }
  Drift(&world_, {}, 1e-5, 50, 1e-4);
}

TEST_F(Box2dPairs, CompleteWhenPeriodic) {
  Fill(&world_, 200, 20.0, 20.0, {-3.0, 0.0});
  Box2dOptions options;
  options.period = 20.0;
  options.period_origin = -3.0;
  Drift(&world_, options, 0.02, 200, 0.05);
}

TEST_F(Box2dPairs, CompleteInANarrowPeriod) {
  for (int i = 0; i < 30; ++i) AddDisk(&world_, {0.3f * i, 1.7f * i}, 1.0f);
  Box2dOptions options;
  options.period = 2.5;
  Drift(&world_, options, 0.02, 100, 0.3);
}

TEST_F(Box2dPairs, AlertMayChangeBothWays) {
  Fill(&world_, 200, 25.0, 25.0);
  Box2dAdapter adapter(&world_);
  for (const double alert : {0.1, 3.0, 0.0, 0.5, 20.0, 0.01}) {
    BodyTable bodies;
    world_.DestroyBody(world_.GetBodyList());
    const ContactTable contacts = Detect(&adapter, alert, &bodies);
    EXPECT_EQ(FoundPairs(bodies, contacts), AllPairs(bodies, bodies.pose, alert, 0.0)) << alert;
  }
}

TEST_F(Box2dPairs, DestroyedPairIsForgottenWhenTheAlertShrinks) {
  b2Body* one = AddDisk(&world_, {3.0f, 3.0f});
  b2Body* other = AddDisk(&world_, {3.5f, 3.0f});
  for (int i = 0; i < 5; ++i) AddDisk(&world_, {10.0f * static_cast<float>(i), 0.0f});
  Box2dAdapter adapter(&world_);
  EXPECT_EQ(Detect(&adapter, 100.0).size(), 21u);
  world_.DestroyBody(one);
  world_.DestroyBody(other);
  EXPECT_EQ(Detect(&adapter, 0.01).size(), 0u);
}

TEST_F(Box2dPairs, HostIsUnchangedByDetection) {
  b2Body* body = AddDisk(&world_, {0.0f, 0.0f});
  Box2dAdapter adapter(&world_);
  BodyTable bodies;
  adapter.ReadBodies(&bodies);
  const std::vector<Pose> poses = {{100.0, 0.0, 1.0}};
  ContactTable contacts;
  adapter.DetectContacts({bodies.id, poses}, 0.1, &contacts);
  EXPECT_EQ(body->GetPosition().x, 0.0f);
  EXPECT_EQ(body->GetAngle(), 0.0f);
  adapter.ReadBodies(&bodies);
  EXPECT_EQ(bodies.pose[0].x, 0.0);
}

TEST_F(Box2dPairs, ChangesOfTheWorldBetweenDetections) {
  Fill(&world_, 120, 18.0, 18.0);
  Box2dAdapter adapter(&world_);
  std::uniform_int_distribution<int> pick(0, 1 << 20);
  for (int k = 0; k < 40; ++k) {
    BodyTable bodies;
    const ContactTable contacts = Detect(&adapter, 0.05, &bodies);
    ASSERT_EQ(FoundPairs(bodies, contacts), AllPairs(bodies, bodies.pose, 0.05, 0.0)) << k;
    const auto any = [&] { return adapter.Find(bodies.id[static_cast<std::size_t>(pick(random_)) % bodies.size()]); };
    b2Body* victim = any();
    world_.DestroyBody(victim);
    b2Body* changed = any();
    if (changed != nullptr && changed != victim) changed->SetType(k % 2 == 0 ? b2_dynamicBody : b2_kinematicBody);
    Fill(&world_, 1, 18.0, 18.0);
    AddDisk(&world_, {9.0f, 9.0f}, 0.5f);
  }
}

TEST_F(Box2dPairs, FiltersAreHonoured) {
  const auto touches = [this](b2Filter one, b2Filter other) {
    b2World world({0.0f, 0.0f});
    AddDisk(&world, {0.0f, 0.0f})->GetFixtureList()->SetFilterData(one);
    AddDisk(&world, {1.0f, 0.0f})->GetFixtureList()->SetFilterData(other);
    Box2dAdapter adapter(&world);
    return Detect(&adapter, 0.0).size() == 1;
  };
  const auto filter = [](int category, int mask, int group) {
    b2Filter f;
    f.categoryBits = static_cast<std::uint16_t>(category);
    f.maskBits = static_cast<std::uint16_t>(mask);
    f.groupIndex = static_cast<std::int16_t>(group);
    return f;
  };
  EXPECT_TRUE(touches(filter(1, 0xFFFF, 0), filter(2, 0xFFFF, 0)));
  EXPECT_FALSE(touches(filter(1, 0xFFFD, 0), filter(2, 0xFFFF, 0)));
  EXPECT_FALSE(touches(filter(1, 0xFFFF, 0), filter(2, 0xFFFE, 0)));
  EXPECT_TRUE(touches(filter(1, 0, 3), filter(2, 0, 3)));
  EXPECT_FALSE(touches(filter(1, 0xFFFF, -3), filter(2, 0xFFFF, -3)));
  EXPECT_TRUE(touches(filter(1, 0xFFFF, -3), filter(2, 0xFFFF, -4)));
}

TEST_F(Box2dPairs, UsersContactFilterIsAsked) {
  struct Filter final : b2ContactFilter {
    bool ShouldCollide(b2Fixture* a, b2Fixture* b) override { return a->GetBody() != refused && b->GetBody() != refused; }
    b2Body* refused = nullptr;
  } filter;
  AddDisk(&world_, {0.0f, 0.0f});
  AddDisk(&world_, {1.0f, 0.0f});
  filter.refused = AddDisk(&world_, {2.0f, 0.0f});
  world_.SetContactFilter(&filter);
  Box2dAdapter adapter(&world_);
  EXPECT_EQ(Detect(&adapter, 0.0).size(), 1u);
}

TEST_F(Box2dPairs, JointsMayActAsFilters) {
  b2Body* a = AddDisk(&world_, {0.0f, 0.0f});
  b2Body* b = AddDisk(&world_, {1.0f, 0.0f});
  AddDisk(&world_, {2.0f, 0.0f});
  b2DistanceJointDef joint;
  joint.Initialize(a, b, a->GetPosition(), b->GetPosition());
  joint.collideConnected = false;
  world_.CreateJoint(&joint);
  Box2dOptions options;
  options.joints_only_filter = true;
  Box2dAdapter adapter(&world_, options);
  EXPECT_EQ(Detect(&adapter, 0.0).size(), 2u) << "the first and the third touch exactly";
}

TEST_F(Box2dPairs, WallsBesideWallsCostNothing) {
  b2Body* ground = AddBody(&world_, b2_staticBody, {0.0f, 0.0f});
  for (int i = 0; i < 20000; ++i) AddEdge(ground, {-100.0f, 0.001f * i}, {100.0f, 0.001f * i});  // boxes all overlap
  AddDisk(&world_, {0.0f, -10.0f});
  Box2dAdapter adapter(&world_);
  EXPECT_EQ(Detect(&adapter, 9.0).size(), 1u);  // 2e8 pairs of walls would not end here
}

}  // namespace
}  // namespace nscdd::box2d
