// SPDX-License-Identifier: Apache-2.0
// Box2D's answers on Box2D's own surface.

#include <box2d/box2d.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/interpenetration.h"
#include "nscdd/reference/reference_adapter.h"
#include "scene/read_scene.h"
#include "tradeoff/box2d_surface.h"
#include "tradeoff/contestant.h"
#include "tradeoff/course.h"

namespace nscdd {
namespace {

constexpr double kSkin = 0.01, kSlop = 0.005;  // [m] b2_polygonRadius, b2_linearSlop at a metre a unit

/// A disk above a segment through the origin and beside another disk, each `gap` away. The segment's body has the id `wall`.
ContactTable DetectOnSkin(double gap, double alert, std::int64_t wall) {
  reference::World world;
  reference::Body ground = reference::MakeWall(wall);
  ground.segments = {{{-5.0, 0.0}, {5.0, 0.0}}};
  world.Add(ground);
  world.Add(reference::MakeDisk(1, {0.0, 2.0 + gap}, 2.0, 1.0));
  world.Add(reference::MakeDisk(2, {3.0 + gap, 2.0 + gap}, 1.0, 1.0));
  reference::ReferenceAdapter adapter(&world);
  Box2dSurface surface(&adapter, {{{wall, 0}, kSkin}});
  BodyTable bodies;
  surface.ReadBodies(&bodies);
  ContactTable contacts;
  surface.DetectContacts({bodies.id, bodies.pose}, alert, &contacts);
  return contacts;
}

TEST(Box2dSurface, OnlyWallsHaveASkin) {
  for (const std::int64_t wall : {0, 9}) {  // as A and as B
    const ContactTable t = DetectOnSkin(0.004, 0.1, wall);
    ASSERT_EQ(t.size(), 2u);
    const std::size_t on_wall = wall == 0 ? 0 : 1, between = 1 - on_wall;
    const auto& disk = wall == 0 ? t.lever_b : t.lever_a;
    const auto& segment = wall == 0 ? t.lever_a : t.lever_b;
    EXPECT_NEAR(t.gap[on_wall], 0.004 - kSkin, 1e-14);
    EXPECT_NEAR(disk[on_wall], 2.0 - 0.003, 1e-14);  // half-way between the surfaces, which overlap by 0.006
    EXPECT_NEAR(segment[on_wall], kSkin - 0.003, 1e-14);
    EXPECT_NEAR(t.gap[between], 0.004, 1e-14);
    EXPECT_NEAR(t.lever_a[between], 2.002, 1e-14);
    EXPECT_NEAR(t.lever_b[between], 1.002, 1e-14);
  }
}

TEST(Box2dSurface, TheAlertDistanceIsFromTheSkin) {
  const ContactTable t = DetectOnSkin(0.105, 0.1, 0);
  ASSERT_EQ(t.size(), 1u);  // of the wall; the two disks are 0.105 apart
  EXPECT_NEAR(t.gap[0], 0.095, 1e-14);
  EXPECT_EQ(t.normal.size() + t.site.size() + t.flat.size() + t.friction.size() + t.shape_b.size(), 5u);
  EXPECT_TRUE(DetectOnSkin(0.2, 0.1, 0).gap.empty());
}

/// Where a disk of radius 1/2 comes to rest in Box2D, with what `add` gives the ground.
std::vector<double> GapsAtRest(Vec2 start, const std::function<void(b2Body*)>& add) {
  b2World world({0.0f, -9.81f});
  world.SetAllowSleeping(false);
  b2BodyDef definition;
  b2Body* ground = world.CreateBody(&definition);
  add(ground);
  definition.type = b2_dynamicBody;
  definition.position.Set(static_cast<float>(start.x), static_cast<float>(start.y));
  b2CircleShape circle;
  circle.m_radius = 0.5f;
  b2Body* disk = world.CreateBody(&definition);
  disk->CreateFixture(&circle, 1.0f);
  for (int k = 0; k < 400; ++k) world.Step(0.01f, 8, 3);

  box2d::Box2dAdapter adapter(&world);
  std::map<Box2dSurface::ShapeName, double> skins;
  for (const b2Fixture* f = ground->GetFixtureList(); f != nullptr; f = f->GetNext()) {
    const auto number = static_cast<std::int32_t>(skins.size());
    if (f->GetType() != b2Shape::e_circle) skins[{0, number}] = f->GetShape()->m_radius;
  }
  adapter.Assign(ground, 0);
  adapter.Assign(disk, 1);
  Box2dSurface surface(&adapter, skins);
  const BodyTable bodies = ReadSortedBodies(&surface);
  ContactTable contacts;
  surface.DetectContacts({bodies.id, bodies.pose}, 0.05, &contacts);
  return contacts.gap;
}

void AddEdge(b2Body* ground, b2Vec2 a, b2Vec2 b) {
  b2EdgeShape edge;
  edge.SetTwoSided(a, b);
  ground->CreateFixture(&edge, 0.0f);
}

void AddBox(b2Body* ground, b2Vec2 centre, float half) {
  b2PolygonShape box;
  box.SetAsBox(half, half, centre, 0.0f);
  ground->CreateFixture(&box, 0.0f);
}

void AddCircle(b2Body* ground, b2Vec2 centre) {
  b2CircleShape circle;
  circle.m_radius = 0.5f;
  circle.m_p = centre;
  ground->CreateFixture(&circle, 0.0f);
}

/// Sides and corners, of whatever shape: the gap of Box2D's own surface ends within the slop.
TEST(Box2dSurface, ADiskAtRestOverlapsItByAtMostTheSlop) {
  const struct {
    const char* name;
    Vec2 start;
    std::size_t contacts;
    std::function<void(b2Body*)> add;
  } kCases[] = {{"side of an edge",
                 {0.0, 0.5},
                 1,
                 [](b2Body* g) {
                   AddEdge(g, {-5.0f, 0.0f}, {5.0f, 0.0f});
                 }},
                {"side of a polygon",
                 {0.0, 0.5},
                 1,
                 [](b2Body* g) {
                   AddBox(g, {0.0f, -1.0f}, 1.0f);
                 }},
                {"ends of edges",
                 {0.0, 0.45},
                 2,
                 [](b2Body* g) {
                   AddEdge(g, {-5.0f, 0.0f}, {-0.25f, 0.0f});
                   AddEdge(g, {0.25f, 0.0f}, {5.0f, 0.0f});
                 }},
                {"corners of polygons",
                 {0.0, 0.45},
                 2,
                 [](b2Body* g) {
                   AddBox(g, {-1.25f, -1.0f}, 1.0f);
                   AddBox(g, {1.25f, -1.0f}, 1.0f);
                 }},
                {"disks", {0.0, 0.9}, 2, [](b2Body* g) {
                   AddCircle(g, {-0.5f, 0.0f});
                   AddCircle(g, {0.5f, 0.0f});
                 }}};
  for (const auto& c : kCases) {
    const std::vector<double> gaps = GapsAtRest(c.start, c.add);
    EXPECT_EQ(gaps.size(), c.contacts) << c.name;
    for (const double gap : gaps) {
      EXPECT_GT(gap, -kSlop - 1e-5) << c.name;
      EXPECT_LT(gap, 1e-6) << c.name;
    }
  }
}

struct Rest {
  AnswerResiduals residuals;
  double interpenetration = 0.0;
};

/// The last of 400 steps of Box2D.
Rest RestOn(const std::string& walls, const std::string& velocity, const std::string& position) {
  const Scene scene =
      ParseScene("[time]\ndt = 0.01\nsteps = 400\n" + walls + "[[disks]]\ncentre = [0.0, 0.5]\nradius = 0.5\n", "rest.toml");
  const auto contestant =
      MakeBox2dContestant(scene, {"b", "box2d", {{"velocity_iterations", velocity}, {"position_iterations", position}}});
  contestant->KeepImpulses(true);
  contestant->SetGravity({0.0, -9.81});
  SteppingOptions stepping;
  stepping.alert_distance = 0.05;
  for (int k = 1; k < 400; ++k) contestant->Step(0.01);
  const StepProblem problem = contestant->Read(stepping, 0.01);
  contestant->Step(0.01);
  const StepEnd end = ReadStepEnd(contestant.get(), problem);
  return {MeasureAnswer(problem.problem, end.answer),
          MeasureInterpenetration(&contestant->adapter(), problem.bodies.id, end.pose, 0.05).max};
}

TEST(Box2dContestant, ADiskAtRestIsAnExactAnswerOnEveryWall) {
  const std::string kWalls[] = {"[[walls]]\ntype = \"segments\"\npoints = [[-5.0, 0.0], [5.0, 0.0]]\n",
                                "[[walls]]\ntype = \"half_plane\"\npoint = [0.0, 0.0]\n",
                                "[[walls]]\ntype = \"disks\"\nradius = 0.5\npoints = [[0.0, -0.5], [2.0, -0.5]]\n"};
  for (const std::string& walls : kWalls) {
    for (const auto& [velocity, position] : {std::pair{"8", "3"}, {"200", "50"}}) {
      const Rest rest = RestOn(walls, velocity, position);
      EXPECT_LT(rest.residuals.nat, 1e-5) << walls << velocity;
      EXPECT_LT(rest.residuals.nat_max, 1e-5) << walls << velocity;
      EXPECT_LT(rest.residuals.momentum_defect, 1e-5) << walls << velocity;
      EXPECT_LT(std::abs(rest.residuals.energy_defect), 1e-5) << walls << velocity;
      EXPECT_LT(rest.interpenetration, kSlop + 1e-4) << walls << velocity;
    }
  }
}

/// Two disks that meet while one passes the other: impulses and velocities balance in the frame at the beginning of the step.
TEST(Box2dContestant, ImpulsesBalanceInItsOwnFrame) {
  const Scene scene = ParseScene(
      "[time]\ndt = 0.01\nsteps = 1\n[[disks]]\ncentre = [0.0, 0.0]\nradius = 0.5\n"
      "[[disks]]\ncentre = [0.0, 0.995]\nradius = 0.5\nvelocity = [20.0, -2.0]\n",
      "pass.toml");
  const auto contestant =
      MakeBox2dContestant(scene, {"b", "box2d", {{"velocity_iterations", "50"}, {"position_iterations", "1"}}});
  contestant->KeepImpulses(true);
  contestant->SetGravity({0.0, -9.81});
  SteppingOptions stepping;
  stepping.alert_distance = 0.05;
  const StepProblem problem = contestant->Read(stepping, 0.01);
  ASSERT_EQ(problem.keys.size(), 1u);
  EXPECT_NEAR(problem.problem.contacts.normal[0].x, 0.0, 1e-6);
  contestant->Step(0.01);
  const Answer answer = ReadStepEnd(contestant.get(), problem).answer;
  EXPECT_GT(answer.impulse[0].x, 0.1);
  EXPECT_LT(MeasureAnswer(problem.problem, answer).momentum_defect, 1e-4);
}

}  // namespace
}  // namespace nscdd
