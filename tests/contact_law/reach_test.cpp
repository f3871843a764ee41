// SPDX-License-Identifier: Apache-2.0
// Whatever its radius and speed, up to 20 radii a step, nothing goes into or through anything: contacts are found in time.

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "bar.h"

namespace nscdd::contact_law {
namespace {

constexpr int kDrops = 1000;

template <class S>
class Reach : public testing::Test {};
TYPED_TEST_SUITE(Reach, Platforms, PlatformNames);

/// The numbers of one drop, all at random.
struct Drop {
  explicit Drop(Random* r) : random(*r) {
    radius = random.LogUniform(1e-3, 10.0);
    dt = random.LogUniform(1e-4, 0.05);
    advance = radius * (random.Chance(0.3) ? random.LogUniform(1e-3, 20.0) : random.Uniform(0.0, 20.0));
    origin = random.Uniform(0.0, 100.0) * radius * random.Direction();
    gravity = (random.Uniform(0.0, 0.1) * radius / (dt * dt)) * random.Direction();
    material = {random.OneOf({0.0, 0.3, 1.0}), random.OneOf({0.0, 0.0, 0.5, 1.0})};
  }

  /// Where a body begins that is to arrive, in the first three steps, at `target` from the side of `normal`, relative to it.
  Vec2 Begin(Vec2 target, Vec2 normal) {
    direction = Rotate(random.Uniform(-1.3, 1.3), -1.0 * normal);
    return target - (random.Uniform(0.0, 2.0) * advance + 1e-9 * radius) * direction;
  }
  /// Velocity of it, relative to what it falls on.
  Vec2 Approach() const { return (advance / dt) * direction; }
  template <class S>
  std::unique_ptr<S> MakeScene(const SteppingOptions& stepping = {}, const AlgorithmOptions& algorithm = NscdOptions{},
                               double period = 0.0) {
    auto scene = std::make_unique<S>(radius * random.Uniform(0.5, 2.0), stepping, algorithm, period);
    scene->SetGravity(gravity);
    return scene;
  }

  Random& random;
  double radius, dt;
  double advance;  ///< [m] that a step covers
  Vec2 origin, gravity, direction;
  Material material;
};

/// Steps until everything has happened; what was deep or on the wrong side, if anything.
std::string Watch(const Drop& drop, Scene* scene, int steps = 8, double allowed_turn = 1e300) {
  if (Judge(*scene).depth > 0.0) return "a fault of the test: bodies overlap at the beginning";
  for (int k = 1; k <= steps; ++k) {
    scene->Step(drop.dt);
    const Verdict verdict = Judge(*scene);
    if (verdict.largest_turn > allowed_turn) return {};
    if (verdict.Fails()) {
      return fmt::format(
          "radius {:.3g} m, dt {:.3g} s, {:.3g} radii a step, friction {}, restitution {}: step {} leaves {:.3g} radii of "
          "overlap{}{}",
          drop.radius, drop.dt, drop.advance / drop.radius, drop.material.friction, drop.material.restitution, k, verdict.depth,
          verdict.passed.empty() ? "" : ", passed: ", verdict.passed);
    }
  }
  return {};
}

/// A wall of one shape at the origin of its frame, a point of its surface and a normal there that leads out of it.
struct Target {
  Wall wall;
  Vec2 point, normal;
};

enum class Kind { kLine, kPlane, kPolygon, kDisk };

Target MakeTarget(Kind kind, double radius, Random* random) {
  Target target;
  if (kind == Kind::kLine) {
    const double half = radius * random->LogUniform(0.1, 50.0);
    target.wall.lines = {{{-half, 0.0}, {half, 0.0}}};
    target.normal = {0.0, random->Sign()};
    if (random->Chance(0.3)) {  // the end
      target.point = {half, 0.0};
      target.normal = Rotate(random->Uniform(-0.5, 0.5) * std::numbers::pi, {1.0, 0.0});
    } else {
      target.point = {random->Uniform(-half, half), 0.0};
    }
  } else if (kind == Kind::kPlane) {
    target.normal = random->Direction();
    const double offset = radius * random->Uniform(-5.0, 5.0);
    target.wall.planes = {{target.normal, offset}};
    target.point = offset * target.normal + radius * random->Uniform(-5.0, 5.0) * Vec2{-target.normal.y, target.normal.x};
  } else if (kind == Kind::kDisk) {
    const double other = radius * random->LogUniform(0.1, 10.0);
    target.wall.disks = {{{}, other}};
    target.normal = random->Direction();
    target.point = other * target.normal;
  } else {
    const int count = 3 + random->Below(5);
    const double half_length = radius * random->LogUniform(0.1, 30.0), half_width = radius * random->LogUniform(0.02, 10.0);
    Polygon polygon;
    const double turn = random->Uniform(0.0, 1.0);
    for (int i = 0; i < count; ++i) {
      const Vec2 p = Rotate(2.0 * std::numbers::pi * (i + turn) / count, {1.0, 0.0});
      polygon.vertices.push_back({half_length * p.x, half_width * p.y});
    }
    const int side = random->Below(count);
    const Vec2 a = polygon.vertices[side], b = polygon.vertices[(side + 1) % count], along = (1.0 / Norm(b - a)) * (b - a);
    target.normal = {along.y, -along.x};
    target.point = a + random->Uniform(0.0, 1.0) * (b - a);
    target.wall.polygons = {polygon};
  }
  return target;
}

/// Turns and moves the target to where the drop happens.
void Place(const Drop& drop, Random* random, Target* target) {
  target->wall.pose = {drop.origin.x, drop.origin.y, random->Uniform(-3.0, 3.0)};
  target->wall.material = drop.material;
  target->point = InWorld(target->wall.pose, target->point);
  target->normal = Rotate(target->wall.pose.angle, target->normal);
}

template <class S>
std::string DropADisk(Kind kind, Random& random) {
  Drop drop(&random);
  const auto scene = drop.MakeScene<S>();
  Target target = MakeTarget(kind, drop.radius, &random);
  Place(drop, &random, &target);
  const Vec2 begin = drop.Begin(target.point + drop.radius * target.normal, target.normal);
  scene->Add(target.wall);
  scene->AddDisk(begin, drop.radius, {drop.Approach().x, drop.Approach().y, random.Uniform(-1.0, 1.0) / drop.dt},
                 drop.material);
  return Watch(drop, scene.get());
}

TYPED_TEST(Reach, DisksOnSegments) {
  EXPECT_TRUE(NoneOf(kDrops, 1000, [](Random& random) { return DropADisk<TypeParam>(Kind::kLine, random); }));
}

TYPED_TEST(Reach, DisksOnHalfPlanes) {
  EXPECT_TRUE(NoneOf(kDrops, 3000, [](Random& random) { return DropADisk<TypeParam>(Kind::kPlane, random); }));
}

TYPED_TEST(Reach, DisksOnPolygons) {
  if (!TypeParam::kHasPolygons) GTEST_SKIP() << "no polygons on this platform";
  EXPECT_TRUE(NoneOf(kDrops, 5000, [](Random& random) { return DropADisk<TypeParam>(Kind::kPolygon, random); }));
}

TYPED_TEST(Reach, DisksOnFixedDisks) {
  EXPECT_TRUE(NoneOf(kDrops, 7000, [](Random& random) { return DropADisk<TypeParam>(Kind::kDisk, random); }));
}

TYPED_TEST(Reach, DisksOnFreeDisks) {
  EXPECT_TRUE(NoneOf(kDrops, 9000, [](Random& random) {
    Drop drop(&random);
    const auto scene = drop.MakeScene<TypeParam>();
    const double other = drop.radius * random.LogUniform(0.1, 10.0);
    const Vec2 normal = random.Direction(), begin = drop.Begin(drop.origin + (drop.radius + other) * normal, normal);
    const Vec2 common = (random.Uniform(0.0, 10.0) * drop.radius / drop.dt) * random.Direction();
    const Vec2 v = common + drop.Approach();
    scene->AddDisk(drop.origin, other, {common.x, common.y, random.Uniform(-1.0, 1.0) / drop.dt}, drop.material);
    scene->AddDisk(begin, drop.radius, {v.x, v.y, random.Uniform(-1.0, 1.0) / drop.dt}, drop.material);
    return Watch(drop, scene.get());
  }));
}

/// Two or three disks, each touching or overlapping the next, about their centre of mass.
Grain MakeCluster(double radius, Random* random) {
  Grain grain;
  const int count = 2 + random->Below(2);
  Vec2 at, centre;
  double mass = 0.0;
  for (int i = 0; i < count; ++i) {
    const double r = radius * random->Uniform(0.5, 1.0);
    if (i > 0)
      at = at + random->Uniform(0.5, 1.0) * (r + grain.disks.back().radius) * Rotate(random->Uniform(-1.0, 1.0), {1.0, 0.0});
    grain.disks.push_back({at, r});
    mass += r * r;
    centre = centre + r * r * at;
  }
  for (Circle& disk : grain.disks) disk.centre = disk.centre - (1.0 / mass) * centre;
  return grain;
}

/// The cluster's lowest point along `normal`, at its angle, is to arrive at the target.
template <class S>
std::string DropACluster(Kind kind, Random& random) {
  Drop drop(&random);
  const auto scene = drop.MakeScene<S>();
  Target target = MakeTarget(kind, drop.radius, &random);
  if (kind == Kind::kLine) {
    target.wall.lines = {{{-200.0 * drop.radius, 0.0}, {200.0 * drop.radius, 0.0}}};  // nothing turns about an end
    target.normal = {0.0, random.Sign()};
  }
  Place(drop, &random, &target);
  Grain grain = MakeCluster(drop.radius, &random);
  double height = 0.0;
  for (const Circle& disk : grain.disks) height = std::max(height, Norm(disk.centre) + disk.radius);
  const Vec2 begin = drop.Begin(target.point + height * target.normal, target.normal), v = drop.Approach();
  grain.pose = {begin.x, begin.y, random.Uniform(-3.0, 3.0)};
  grain.velocity = {v.x, v.y, random.Uniform(-1.0, 1.0) / drop.dt};
  grain.material = drop.material;
  scene->Add(target.wall);
  scene->Add(grain);
  return Watch(drop, scene.get(), 8, 1.0);
}

/// Of 1000 trials in which something turns with an arm; none is the aim. A half-plane that is fixed for a step only
/// approaches the way of a point on an arc.
constexpr int kTurningMisses = 10;

TYPED_TEST(Reach, ClustersOnSegments) {
  EXPECT_TRUE(
      FewOf(kTurningMisses, kDrops, 11000, [](Random& random) { return DropACluster<TypeParam>(Kind::kLine, random); }));
}

TYPED_TEST(Reach, ClustersOnHalfPlanes) {
  EXPECT_TRUE(
      FewOf(kTurningMisses, kDrops, 13000, [](Random& random) { return DropACluster<TypeParam>(Kind::kPlane, random); }));
}

TYPED_TEST(Reach, ClustersOnFixedDisks) {
  EXPECT_TRUE(
      FewOf(kTurningMisses, kDrops, 15000, [](Random& random) { return DropACluster<TypeParam>(Kind::kDisk, random); }));
}

TYPED_TEST(Reach, ClustersOnPolygons) {
  if (!TypeParam::kHasPolygons) GTEST_SKIP() << "no polygons on this platform";
  EXPECT_TRUE(
      FewOf(kTurningMisses, kDrops, 17000, [](Random& random) { return DropACluster<TypeParam>(Kind::kPolygon, random); }));
}

/// The wall moves, by up to 20 radii a step, and turns, by up to `turn` [rad] a step; the disk has the rest of the approach.
template <class S>
std::string MoveAWall(Kind kind, double turn, Random& random) {
  Drop drop(&random);
  const auto scene = drop.MakeScene<S>();
  Target target = MakeTarget(kind, drop.radius, &random);
  if (kind == Kind::kLine && turn > 0.0) {  // its ends move by a few radii
    const double half = random.Uniform(0.5, 5.0) * drop.radius;
    target.wall.lines = {{{-half, 0.0}, {half, 0.0}}};
    target.point = {random.Uniform(-half, half), 0.0};
    target.normal = {0.0, random.Sign()};
  }
  Place(drop, &random, &target);
  const Vec2 begin = drop.Begin(target.point + drop.radius * target.normal, target.normal);
  const double share = random.OneOf({1.0, 1.0, 0.5, 2.0});
  const Vec2 wall = -share * drop.Approach(), disk = wall + drop.Approach();
  target.wall.velocity = {wall.x, wall.y, random.Uniform(-turn, turn) / drop.dt};
  scene->Add(target.wall);
  scene->AddDisk(begin, drop.radius, {disk.x, disk.y, 0.0}, drop.material);
  return Watch(drop, scene.get());
}

TYPED_TEST(Reach, MovingSegments) {
  EXPECT_TRUE(NoneOf(kDrops, 19000, [](Random& random) { return MoveAWall<TypeParam>(Kind::kLine, 0.0, random); }));
}

TYPED_TEST(Reach, MovingHalfPlanes) {
  EXPECT_TRUE(NoneOf(kDrops, 21000, [](Random& random) { return MoveAWall<TypeParam>(Kind::kPlane, 0.0, random); }));
}

TYPED_TEST(Reach, MovingDisks) {
  EXPECT_TRUE(NoneOf(kDrops, 23000, [](Random& random) { return MoveAWall<TypeParam>(Kind::kDisk, 0.0, random); }));
}

TYPED_TEST(Reach, MovingPolygons) {
  if (!TypeParam::kHasPolygons) GTEST_SKIP() << "no polygons on this platform";
  EXPECT_TRUE(NoneOf(kDrops, 25000, [](Random& random) { return MoveAWall<TypeParam>(Kind::kPolygon, 0.0, random); }));
}

TYPED_TEST(Reach, TurningSegments) {
  EXPECT_TRUE(
      FewOf(kTurningMisses, kDrops, 27000, [](Random& random) { return MoveAWall<TypeParam>(Kind::kLine, 0.3, random); }));
}

/// A half-plane turns by up to 0.1 rad a step about a point that may be far away; a bystander is out of all reach.
TYPED_TEST(Reach, TurningHalfPlanes) {
  EXPECT_TRUE(NoneOf(kDrops, 41000, [](Random& random) {
    Drop drop(&random);
    drop.gravity = {};
    const auto scene = drop.MakeScene<TypeParam>();
    const double r = drop.radius, angle = random.Uniform(-3.0, 3.0), along = random.Uniform(-50.0, 50.0) * r;
    const Wall wall{.pose = {drop.origin.x, drop.origin.y, angle},
                    .velocity = {0.0, 0.0, random.Uniform(-0.1, 0.1) / drop.dt},
                    .planes = {{{0.0, 1.0}, 0.0}},
                    .material = drop.material};
    scene->Add(wall);
    scene->AddDisk(InWorld(wall.pose, {along, r * (1.0 + random.Uniform(0.0, 10.0))}), r, {}, drop.material);
    scene->AddDisk(InWorld(wall.pose, {0.0, 500.0 * r}), r, {}, drop.material);
    return Watch(drop, scene.get());
  }));
}

/// A long segment that turns, on a body that has a half-plane too (far away): its end sweeps several radii in a step.
TYPED_TEST(Reach, TurningSegmentBesideAHalfPlane) {
  EXPECT_TRUE(NoneOf(300, 43000, [](Random& random) {
    Drop drop(&random);
    drop.gravity = {};
    const auto scene = drop.MakeScene<TypeParam>();
    const double r = drop.radius, angle = random.Uniform(-3.0, 3.0);
    const Wall wall{.pose = {drop.origin.x, drop.origin.y, angle},
                    .velocity = {0.0, 0.0, random.Uniform(0.05, 0.2) / drop.dt},
                    .lines = {{{0.0, 0.0}, {60.0 * r, 0.0}}},
                    .planes = {{{0.0, 1.0}, -1000.0 * r}},
                    .material = drop.material};
    scene->Add(wall);
    scene->AddDisk(InWorld(wall.pose, {r * random.Uniform(10.0, 30.0), r * random.Uniform(1.0, 4.0)}), r, {}, drop.material);
    return Watch(drop, scene.get(), 4);
  }));
}

/// Up to 20 radii a step into five disks that lie about.
TYPED_TEST(Reach, SegmentSweepsFiveDisks) {
  EXPECT_TRUE(NoneOf(100, 29000, [](Random& random) {
    Drop drop(&random);
    drop.gravity = {};
    const auto scene = drop.MakeScene<TypeParam>({}, Exact(1e-10));
    const double reach = 200.0 * drop.radius;
    Wall wall{.pose = {drop.origin.x, drop.origin.y, 0.0}, .lines = {{{-reach, 0.0}, {reach, 0.0}}}, .material = drop.material};
    wall.velocity.vy = drop.advance / drop.dt;
    scene->Add(wall);
    for (int i = 0; i < 5; ++i) {
      const Vec2 at{2.0 * drop.radius * (i % 2 + random.Uniform(-0.1, 0.1)), drop.radius * (1.01 + 2.5 * i)};
      scene->AddDisk(drop.origin + at, drop.radius * random.Uniform(0.5, 0.9), {}, drop.material);
    }
    return Watch(drop, scene.get());
  }));
}

/// A corner of two segments, open by 30 to 150 degrees, into which the disk flies.
TYPED_TEST(Reach, Corners) {
  EXPECT_TRUE(NoneOf(kDrops, 31000, [](Random& random) {
    Drop drop(&random);
    const auto scene = drop.MakeScene<TypeParam>();
    const double half = random.Uniform(0.26, 1.3), length = 100.0 * drop.radius;
    const Wall wall{.pose = {drop.origin.x, drop.origin.y, random.Uniform(-3.0, 3.0)},
                    .lines = {{Rotate(half, {length, 0.0}), {}}, {{}, Rotate(-half, {length, 0.0})}},
                    .material = drop.material};
    scene->Add(wall);
    const double rest = drop.radius / std::sin(half);  // where the disk touches both
    const Vec2 target{rest * random.Uniform(1.0, 2.0), 0.0};
    const double away = std::min(random.Uniform(0.0, 2.0) * drop.advance, 50.0 * drop.radius);
    const Vec2 inner = target + away * Rotate(random.Uniform(-half, half), {1.0, 0.0});
    const Vec2 begin = InWorld(wall.pose, inner), d = target - inner;
    const Vec2 v = Norm(d) > 0.0 ? (drop.advance / drop.dt / Norm(d)) * Rotate(wall.pose.angle, d) : Vec2{};
    scene->AddDisk(begin, drop.radius, {v.x, v.y, 0.0}, drop.material);
    return Watch(drop, scene.get());
  }));
}

/// Disks, one of them fixed, over a floor and under a ceiling, in a period of which they cross up to an eighth in a step.
TYPED_TEST(Reach, AcrossTheSeam) {
  EXPECT_TRUE(NoneOf(300, 39000, [](Random& random) {
    Drop drop(&random);
    const double r = drop.radius, period = r * random.Uniform(9.0, 60.0), largest = std::min(0.12 * period, 20.0 * r);
    drop.gravity.x = 0.0;
    drop.material.restitution *= 0.5;
    drop.advance = largest;
    const auto scene = drop.MakeScene<TypeParam>({}, Exact(1e-10), period);
    scene->Add(Wall{.planes = {{{0.0, 1.0}, 0.0}, {{0.0, -1.0}, -9.0 * r}}, .material = drop.material});
    scene->Add(Wall{.pose = {random.Uniform(0.0, period), 4.5 * r, 0.0}, .disks = {{{}, 0.5 * r}}, .material = drop.material});
    for (const double y : {1.5, 7.5}) {
      const double x = random.Uniform(0.0, period);
      for (int i = 0; i < 3; ++i) {
        const Vec2 v = random.Uniform(0.0, largest) / drop.dt * random.Direction();
        const double at = x + i * period / 3.0;
        scene->AddDisk({at - period * std::floor(at / period), r * (y + random.Uniform(-0.4, 0.4))},
                       r * random.Uniform(0.5, 1.0), {v.x, v.y, 0.0}, drop.material);
      }
    }
    return Watch(drop, scene.get(), 15);
  }));
}

/// Whether every free body lies inside of |x|, |y| < half.
std::string Escaped(const Scene& scene, double half) {
  for (const auto& [id, grain] : scene.grains()) {
    const Pose q = scene.pose(id);
    if (!(std::abs(q.x) < half && std::abs(q.y) < half))
      return fmt::format("body {} is at ({}, {}), the wall at {}", id, q.x, q.y, half);
  }
  return {};
}

Wall MakeBox(double half) {
  return {.lines = {{{-half, -half}, {half, -half}},
                    {{half, -half}, {half, half}},
                    {{half, half}, {-half, half}},
                    {{-half, half}, {-half, -half}}}};
}

/// With the default options: the tolerance of the solver leaves overlaps, but nobody leaves the box.
TYPED_TEST(Reach, FastDiskIntoAPile) {
  EXPECT_TRUE(NoneOf(40, 33000, [](Random& random) -> std::string {
    Drop drop(&random);
    const double r = drop.radius, half = 6.0 * r;
    TypeParam scene(r);
    scene.SetGravity({0.0, -0.01 * r / (drop.dt * drop.dt)});
    Wall box = MakeBox(half);
    box.material = drop.material;
    scene.Add(box);
    for (int i = 0; i < 20; ++i) {
      const Vec2 at{r * (-4.8 + 2.2 * (i % 5) + random.Uniform(-0.05, 0.05)),
                    r * (-4.9 + 2.1 * static_cast<double>(i / 5) + random.Uniform(-0.05, 0.05))};
      scene.AddDisk(at, r * random.Uniform(0.8, 0.95), {}, drop.material);
    }
    const Vec2 v = random.Uniform(1.0, 20.0) * r / drop.dt * Rotate(random.Uniform(-1.2, 1.2), {0.0, -1.0});
    scene.AddDisk({random.Uniform(-4.0, 4.0) * r, 4.7 * r}, r, {v.x, v.y, 0.0}, drop.material);
    for (int k = 1; k <= 20; ++k) {
      scene.Step(drop.dt);
      if (const std::string gone = Escaped(scene, half); !gone.empty()) {
        return fmt::format("radius {:.3g} m, {:.3g} radii a step, restitution {}: step {}: {}", r, Norm(v) * drop.dt / r,
                           drop.material.restitution, k, gone);
      }
    }
    return {};
  }));
}

/// A box three to ten radii wide, crossed several times a step.
TYPED_TEST(Reach, DiskInABox) {
  EXPECT_TRUE(NoneOf(200, 35000, [](Random& random) -> std::string {
    Drop drop(&random);
    const double half = 0.5 * random.Uniform(3.0, 10.0) * drop.radius;
    const auto scene = drop.MakeScene<TypeParam>();
    Wall box = MakeBox(half);
    box.material = {drop.material.friction, random.OneOf({0.0, 0.8, 1.0})};
    scene->Add(box);
    const Vec2 v = (drop.advance / drop.dt) * random.Direction();
    scene->AddDisk({}, drop.radius, {v.x, v.y, 0.0}, drop.material);
    return Watch(drop, scene.get(), 50);
  }));
}

/// A drop of 4.5 m at 60 steps a second, and small fast disks on a thin wall and on a thin box.
TYPED_TEST(Reach, Drops) {
  TypeParam fall;
  fall.SetGravity({0.0, -9.81});
  fall.AddLine({-5.0, 0.0}, {5.0, 0.0}, {0.3, 0.0});
  const auto ball = fall.AddDisk({0.0, 5.0}, 0.5, {}, {0.3, 0.0});
  for (int k = 0; k < 400; ++k) fall.Step(1.0 / 60.0);
  EXPECT_NEAR(fall.pose(ball).y, 0.5, 1e-6);
  for (const bool is_box : {false, true}) {
    if (is_box && !TypeParam::kHasPolygons) continue;
    TypeParam thin;
    thin.SetGravity({0.0, -9.81});
    if (is_box) {
      thin.Add(Wall{.polygons = {{{{-5.0, -0.1}, {5.0, -0.1}, {5.0, 0.0}, {-5.0, 0.0}}}}});
    } else {
      thin.AddLine({-5.0, 0.0}, {5.0, 0.0});
    }
    const auto disk = thin.AddDisk({0.0, 1.7}, 0.1, {0.0, -20.0, 0.0});
    for (int k = 0; k < 60; ++k) thin.Step(1.0 / 60.0);
    EXPECT_NEAR(thin.pose(disk).y, 0.1, 1e-6) << (is_box ? "box" : "segment");
  }
}

/// The same as a Box2D user writes it: floats, an edge, default options.
TEST(ReachInABox2dProgram, Drop) {
  b2World world({0.0F, -10.0F});
  b2BodyDef ground;
  b2EdgeShape edge;
  edge.SetTwoSided({-5.0F, 0.0F}, {5.0F, 0.0F});
  world.CreateBody(&ground)->CreateFixture(&edge, 0.0F);
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = {0.0F, 5.0F};
  b2Body* disk = world.CreateBody(&def);
  b2CircleShape circle;
  circle.m_radius = 0.5F;
  disk->CreateFixture(&circle, 1.0F);
  box2d::Box2dAdapter adapter(&world);
  SerialCommunicator alone;
  TimeStepper stepper({.normal_law = NormalLaw::kImpact}, NscdOptions{}, &adapter, &alone);
  for (int k = 0; k < 400; ++k) stepper.Step(1.0 / 60.0);
  EXPECT_NEAR(disk->GetPosition().y, 0.5F, 1e-6F);
}

template <class Report>
std::int64_t BeyondReach(const Report& report) {
  if constexpr (requires { report.beyond_reach; }) {
    return static_cast<std::int64_t>(report.beyond_reach);
  } else {
    return -1;
  }
}

/// A row of disks at rest, each a radius and more apart; the first is hit so fast that the blow passes along many of them in a
/// step. Whoever is not detected in time is named by the report of the step.
TYPED_TEST(Reach, WhatIsOutOfReachIsReported) {
  int reported = 0;
  EXPECT_TRUE(NoneOf(50, 37000, [&](Random& random) -> std::string {
    Drop drop(&random);
    drop.gravity = {};
    drop.advance = random.Uniform(5.0, 400.0) * drop.radius;
    TypeParam scene(drop.radius, {}, Exact(1e-10));
    const Material material{0.0, random.OneOf({0.0, 1.0})};
    const int count = 12;
    for (int i = 0; i < count; ++i) {
      scene.AddDisk(
          {(2.0 + random.Uniform(0.5, 3.0)) * drop.radius + 5.0 * i * drop.radius, random.Uniform(-0.5, 0.5) * drop.radius},
          drop.radius, {}, material);
    }
    scene.AddDisk({0.0, 0.0}, drop.radius, {drop.advance / drop.dt, 0.0, 0.0}, material);
    for (int k = 1; k <= 3; ++k) {
      const StepReport& report = scene.Step(drop.dt);
      if (BeyondReach(report) < 0) return "the report has no figure beyond_reach";
      reported += BeyondReach(report) > 0;
      const Verdict verdict = Judge(scene);
      if (BeyondReach(report) > 0) return {};
      if (verdict.Fails()) {
        return fmt::format("{:.3g} radii a step: step {} leaves {:.3g} radii of overlap, passed '{}', and beyond_reach is 0",
                           drop.advance / drop.radius, k, verdict.depth, verdict.passed);
      }
    }
    return {};
  }));
  this->RecordProperty("reported", reported);
}

}  // namespace
}  // namespace nscdd::contact_law
