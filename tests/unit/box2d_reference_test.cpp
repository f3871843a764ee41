// SPDX-License-Identifier: Apache-2.0
// The Box2D adapter and the reference adapter over the same random bodies must see the same contacts.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "box2d_support.h"
#include "nscdd/reference/reference_adapter.h"

namespace nscdd::box2d {
namespace {

/// One scene on both platforms. All numbers are floats, so that both hold the same.
class BothPlatforms {
 public:
  BothPlatforms(unsigned seed, double period) : random_(seed), adapter_(&world_, Options(period)), oracle_(&reference_) {
    reference_.period = period;
    for (int i = 0; i < 60; ++i) AddDisk(i);
    for (int i = 60; i < 75; ++i) AddCluster(i);
    AddWalls(75, {3.0f, 2.0f}, 0.0f, period == 0.0);
    AddWalls(76, {7.0f, 9.0f}, 0.7f, period == 0.0);
  }

  void ExpectSameContacts(double alert) {
    BodyTable bodies, bodies_of_oracle;
    ContactTable c, o;
    adapter_.ReadBodies(&bodies);
    oracle_.ReadBodies(&bodies_of_oracle);
    ASSERT_EQ(bodies.id, bodies_of_oracle.id);
    for (int k = 0; k < 30; ++k) {
      adapter_.DetectContacts({bodies_of_oracle.id, bodies_of_oracle.pose}, alert, &c);
      oracle_.DetectContacts({bodies_of_oracle.id, bodies_of_oracle.pose}, alert, &o);
      ASSERT_GT(o.size(), 30u);
      ExpectSame(c, o);
      for (Pose& q : bodies_of_oracle.pose) q = {q.x + Any(-0.1f, 0.1f), q.y + Any(-0.1f, 0.1f), q.angle + Any(-0.1f, 0.1f)};
    }
  }

 private:
  static Box2dOptions Options(double period) {
    Box2dOptions options;
    options.period = period;
    return options;
  }

  float Any(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

  void AddDisk(std::int64_t id) {
    const b2Vec2 centre{Any(0.0f, 12.0f), Any(0.0f, 12.0f)};
    const float radius = Any(0.2f, 0.7f);
    b2Body* body = box2d::AddDisk(&world_, centre, radius);
    adapter_.Assign(body, id);
    reference::Body other = reference::MakeDisk(id, {centre.x, centre.y}, radius, 1.0);
    other.friction = body->GetFixtureList()->GetFriction();
    reference_.Add(other);
  }

  void AddCluster(std::int64_t id) {
    const Pose pose{Any(0.0f, 12.0f), Any(0.0f, 12.0f), Any(-3.0f, 3.0f)};
    b2Body* body = AddBody(&world_, b2_dynamicBody, {static_cast<float>(pose.x), static_cast<float>(pose.y)},
                           static_cast<float>(pose.angle));
    AddCircle(body, 0.375f, {0.25f, 0.0f});
    AddCircle(body, 0.375f, {-0.25f, 0.0f});  // symmetric: the centre of mass is the origin
    adapter_.Assign(body, id);
    reference::Body other;
    other.id = id;
    other.mass = other.inertia = 1.0;
    other.pose = pose;
    other.disks = {{{0.25, 0.0}, 0.375}, {{-0.25, 0.0}, 0.375}};
    other.friction = body->GetFixtureList()->GetFriction();
    reference_.Add(other);
  }

  /// A zigzag of four segments, and a triangle that closes on itself.
  void AddWalls(std::int64_t id, b2Vec2 origin, float angle, bool with_half_plane) {
    b2Body* body = AddBody(&world_, b2_kinematicBody, origin, angle);
    reference::Body other = reference::MakeWall(id, {origin.x, origin.y, angle});
    const b2Vec2 zigzag[] = {{-2.0f, 0.0f}, {-1.0f, 0.5f}, {0.0f, 0.0f}, {1.0f, 0.0f}, {2.0f, -1.5f}};
    b2ChainShape chain;
    chain.CreateChain(zigzag, 5, {-3.0f, 0.0f}, {3.0f, -3.0f});
    body->CreateFixture(&chain, 0.0f);
    const b2Vec2 triangle[] = {{-1.0f, 3.0f}, {1.0f, 3.0f}, {0.0f, 4.0f}};
    b2ChainShape loop;
    loop.CreateLoop(triangle, 3);
    body->CreateFixture(&loop, 0.0f);
    const auto add = [&](b2Vec2 a, b2Vec2 b) { other.segments.push_back({{a.x, a.y}, {b.x, b.y}}); };
    for (int i = 0; i < 4; ++i) add(zigzag[i], zigzag[i + 1]);
    for (int i = 0; i < 3; ++i) add(triangle[i], triangle[(i + 1) % 3]);
    ExactBody exact;
    if (with_half_plane) {
      AddEdge(body, {-50.0f, -1.0f}, {50.0f, -1.0f});
      for (const reference::Segment& s : other.segments) exact.shapes.push_back({SegmentGeometry{s.a, s.b}, {}, {}});
      exact.shapes.push_back({HalfPlaneGeometry{{0.0, 1.0}, -1.0}, {}, {}});
      other.half_planes = {{{0.0, 1.0}, -1.0}};
    }
    other.friction = body->GetFixtureList()->GetFriction();
    adapter_.Assign(body, id, exact);
    reference_.Add(other);
  }

  static void ExpectNear(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(Norm(a[i] - b[i]), 1e-13) << i;
  }

  static void ExpectSame(const ContactTable& c, const ContactTable& o) {
    ASSERT_EQ(c.a, o.a);
    ASSERT_EQ(c.b, o.b);
    ASSERT_EQ(c.shape_a, o.shape_a);
    ASSERT_EQ(c.shape_b, o.shape_b);
    EXPECT_EQ(c.image, o.image);
    EXPECT_EQ(c.flat, o.flat);
    for (std::size_t i = 0; i < c.size(); ++i) {
      EXPECT_NEAR(c.gap[i], o.gap[i], 1e-13) << i;
      EXPECT_NEAR(c.lever_a[i], o.lever_a[i], 1e-13) << i;
      EXPECT_NEAR(c.lever_b[i], o.lever_b[i], 1e-13) << i;
      EXPECT_DOUBLE_EQ(c.friction[i], o.friction[i]) << i;
    }
    ExpectNear(c.normal, o.normal);
    ExpectNear(c.arm_a, o.arm_a);
    ExpectNear(c.arm_b, o.arm_b);
    ExpectNear(c.site, o.site);
  }

  std::mt19937 random_;
  b2World world_{{0.0f, 0.0f}};
  reference::World reference_;
  Box2dAdapter adapter_;
  reference::ReferenceAdapter oracle_;
};

class Box2dAndReference : public testing::TestWithParam<unsigned> {};

TEST_P(Box2dAndReference, SeeTheSameContacts) { BothPlatforms(GetParam(), 0.0).ExpectSameContacts(0.1); }

TEST_P(Box2dAndReference, SeeTheSameContactsInAPeriod) { BothPlatforms(GetParam(), 12.5).ExpectSameContacts(0.1); }

INSTANTIATE_TEST_SUITE_P(Seeds, Box2dAndReference, testing::Range(1u, 6u));

}  // namespace
}  // namespace nscdd::box2d
