// SPDX-License-Identifier: Apache-2.0
// e multiplies the speed with which a pair met, at whatever moment of the step that was; e = 0 does not rebound.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bar.h"

namespace nscdd::contact_law {
namespace {

constexpr double kG = 9.81;

template <class S>
class Restitution : public testing::Test {};
TYPED_TEST_SUITE(Restitution, Platforms, PlatformNames);

/// What a disk falls on.
enum class Floor { kHalfPlane, kSegment, kDisk, kPolygon };

void AddFloorOf(Floor floor, Material material, Scene* scene) {
  if (floor == Floor::kHalfPlane) scene->AddFloor(0.0, material);
  if (floor == Floor::kSegment) scene->AddLine({-10.0, 0.0}, {10.0, 0.0}, material);
  if (floor == Floor::kDisk) scene->Add(Wall{.pose = {0.0, -3.0, 0.0}, .disks = {{{}, 3.0}}, .material = material});
  if (floor == Floor::kPolygon) {
    scene->Add(Wall{.polygons = {{{{-10.0, -1.0}, {10.0, -1.0}, {10.0, 0.0}, {-10.0, 0.0}}}}, .material = material});
  }
}

constexpr double kHeight = 2.0;  ///< [m] of the fall

/// |apex n - e^2n h| / h, the largest of the first three; `phase` in [0, 1) is a part of the way of the step of the first
/// impact.
template <class S>
double ApexError(Floor floor, double e, double dt, double phase) {
  S scene(0.5, {}, Exact());
  scene.SetGravity({0.0, -kG});
  AddFloorOf(floor, {0.0, e}, &scene);
  const double speed = std::sqrt(2.0 * kG * kHeight), height = kHeight + phase * speed * dt;
  const auto disk = scene.AddDisk({0.0, 0.5 + height}, 0.5);
  double worst = 0.0, highest = 0.0, expected = height;
  bool rising = false;
  int apex = 0;
  for (int k = 0; apex < 3 && k * dt < 8.0; ++k) {
    scene.Step(dt);
    const bool up = scene.velocity(disk).vy > 0.0;
    if (up) highest = std::max(rising ? highest : 0.0, scene.pose(disk).y - 0.5);
    if (rising && !up) {
      highest = std::max(highest, scene.pose(disk).y - 0.5);
      expected *= e * e;
      worst = std::max(worst, std::abs(highest - expected) / kHeight);
      ++apex;
    }
    rising = up;
  }
  return apex == 3 ? worst : 1e300;  // it does not rebound at all
}

/// Errors in units of g dt over the speed of the impact: a few for each of three impacts, and so linear in dt.
template <class S>
void ExpectApexes(Floor floor) {
  const double speed = std::sqrt(2.0 * kG * kHeight);
  for (const double e : {0.5, 0.8, 1.0}) {
    double before = 1e300;
    for (const double dt : {4e-3, 1e-3, 2.5e-4}) {
      const int phases = dt < 1e-3 ? 4 : 16;
      double worst = 0.0;
      int at = 0;
      for (int k = 0; k < phases; ++k) {
        const double error = ApexError<S>(floor, e, dt, (k + 0.37) / phases);
        if (error > worst) {
          worst = error;
          at = k;
        }
      }
      EXPECT_LE(worst, 12.0 * kG * dt / speed) << "e " << e << ", dt " << dt << ", phase " << at << " of " << phases;
      EXPECT_LE(worst, std::max(1e-6, 0.4 * before)) << "e " << e << ", dt " << dt << ": the error does not fall with dt";
      before = worst;
    }
  }
}

TYPED_TEST(Restitution, ApexOnAHalfPlane) { ExpectApexes<TypeParam>(Floor::kHalfPlane); }
TYPED_TEST(Restitution, ApexOnASegment) { ExpectApexes<TypeParam>(Floor::kSegment); }
TYPED_TEST(Restitution, ApexOnADisk) { ExpectApexes<TypeParam>(Floor::kDisk); }
TYPED_TEST(Restitution, ApexOnAPolygon) {
  if (!TypeParam::kHasPolygons) GTEST_SKIP() << "no polygons on this platform";
  ExpectApexes<TypeParam>(Floor::kPolygon);
}

/// Two grains of any masses and speeds meet, `largest` radii off their centres at most.
template <class S>
std::string TwoGrains(double offset, double e, Random& random) {
  const double r1 = random.LogUniform(1e-3, 10.0), r2 = r1 * random.LogUniform(0.2, 5.0), dt = random.LogUniform(1e-4, 0.05);
  const double advance = (r1 + r2) * random.LogUniform(1e-3, 5.0), begin = random.Uniform(0.01, 4.0) * advance;
  const Vec2 d = random.Direction(), across{-d.y, d.x}, common = random.Uniform(0.0, 3.0) * r1 / dt * random.Direction();
  const Vec2 v = (advance / dt) * d, u = v + common;
  const double b = random.Uniform(-offset, offset) * (r1 + r2);
  const Vec2 x = b * across - (begin + std::sqrt((r1 + r2) * (r1 + r2) - b * b)) * d;
  S scene(r1);
  const auto rests = scene.AddDisk({}, r2, {common.x, common.y, 0.0}, {0.0, e});
  const auto comes = scene.AddDisk(x, r1, {u.x, u.y, 0.0}, {0.0, e});
  const double meeting = TimeOfMeeting(x, v, r1 + r2);
  const Vec2 at = x + meeting * v, n = (1.0 / Norm(at)) * at, t{n.y, -n.x};
  for (int k = 0; k < static_cast<int>(meeting / dt) + 3; ++k) scene.Step(dt);
  const Vec2 after = Linear(scene.velocity(comes)) - Linear(scene.velocity(rests));
  const double bound = 1e-3 * Norm(v);
  if (std::abs(Dot(after, n) + e * Dot(v, n)) <= 1e-3 * std::abs(Dot(v, n)) && std::abs(Dot(after, t) - Dot(v, t)) <= bound)
    return {};
  return fmt::format(
      "radii {:.3g} and {:.3g} m, {:.3g} of their sum a step, {:.3g} off: approach {:.6g} m/s, leave with {:.6g} = {:.4g} of "
      "it, along the "
      "surface {:.6g} and then {:.6g}",
      r1, r2, advance / (r1 + r2), b / (r1 + r2), -Dot(v, n), Dot(after, n), -Dot(after, n) / Dot(v, n), Dot(v, t),
      Dot(after, t));
}

TYPED_TEST(Restitution, TwoGrainsHeadOn) {
  EXPECT_TRUE(NoneOf(200, 1000, [](Random& random) { return TwoGrains<TypeParam>(0.0, 0.5, random); }));
}
TYPED_TEST(Restitution, TwoGrainsAside) {
  EXPECT_TRUE(NoneOf(200, 2000, [](Random& random) { return TwoGrains<TypeParam>(0.9, 0.5, random); }));
}
TYPED_TEST(Restitution, TwoGrainsOfAnyRestitution) {
  EXPECT_TRUE(NoneOf(200, 3000, [](Random& random) { return TwoGrains<TypeParam>(0.9, random.Uniform(0.0, 1.0), random); }));
}

/// A moving wall: e of the approach speed relative to it.
TYPED_TEST(Restitution, MovingWall) {
  EXPECT_TRUE(NoneOf(200, 4000, [](Random& random) -> std::string {
    const double radius = random.LogUniform(1e-3, 10.0), dt = random.LogUniform(1e-4, 0.05), e = random.Uniform(0.0, 1.0);
    const double advance = radius * random.LogUniform(1e-2, 5.0), share = random.Uniform(-1.0, 2.0),
                 angle = random.Uniform(-3.0, 3.0);
    const Vec2 n = Rotate(angle, {0.0, 1.0}), wall = (share * advance / dt) * n, disk = ((share - 1.0) * advance / dt) * n;
    TypeParam scene(radius);
    scene.Add(Wall{.pose = {0.0, 0.0, angle},
                   .velocity = {wall.x, wall.y, 0.0},
                   .lines = {{{-20.0 * radius, 0.0}, {20.0 * radius, 0.0}}},
                   .material = {0.0, e}});
    const double gap = random.Uniform(0.0, 3.0) * advance;
    const auto id = scene.AddDisk((radius + gap) * n, radius, {disk.x, disk.y, 0.0});
    for (int k = 0; k < 6; ++k) scene.Step(dt);
    const double leaves = Dot(Linear(scene.velocity(id)) - wall, n) * dt / advance;
    return std::abs(leaves - e) <= 1e-3
               ? ""
               : fmt::format("e {:.4g}, {:.3g} radii a step: leaves with {:.4g} of the approach", e, advance / radius, leaves);
  }));
}

/// e = 1 between two plates: the speed between impacts stays, and so does the ball.
TYPED_TEST(Restitution, BallBetweenPlates) {
  EXPECT_TRUE(NoneOf(100, 5000, [](Random& random) -> std::string {
    const double radius = random.LogUniform(1e-2, 10.0), dt = random.LogUniform(1e-4, 0.05),
                 room = radius * random.LogUniform(0.1, 10.0);
    const double advance = room * (random.Chance(0.7) ? random.LogUniform(0.01, 0.25) : random.Uniform(0.25, 3.0));
    const double angle = random.Uniform(-3.0, 3.0);
    const Vec2 n = Rotate(angle, {0.0, 1.0}), t = Rotate(angle, {1.0, 0.0}),
               v = (advance / dt) * n + random.Uniform(-0.01, 0.01) * radius / dt * t;
    TypeParam scene(radius);
    const Material material{0.0, 1.0};
    const double high = 0.5 * room + radius, length = 100.0 * radius;
    const bool planes = random.Chance(0.5);
    for (const double side : {-1.0, 1.0}) {
      Wall wall{.pose = {0.0, 0.0, angle}, .material = material};
      if (planes) wall.planes = {{{0.0, -side}, -high}};
      if (!planes) wall.lines = {{{-length, side * high}, {length, side * high}}};
      scene.Add(wall);
    }
    const auto ball = scene.AddDisk(random.Uniform(-0.49, 0.49) * room * n, radius, {v.x, v.y, 0.0}, material);
    const double speed = Norm(v);
    for (int k = 1; k <= 2000; ++k) {
      const StepReport& report = scene.Step(dt);
      const Pose q = scene.pose(ball);
      const double now = Norm(Linear(scene.velocity(ball))), off = std::abs(Dot(Centre(q), n)) - 0.5 * room;
      if (off > 1e-3 * radius)
        return fmt::format("{:.3g} rooms a step: step {}: {:.3g} radii into a plate", advance / room, k, off / radius);
      const bool between = advance <= 0.25 * room && report.solve.active == 0;
      if ((between && std::abs(now - speed) > 1e-9 * speed) || now > (1.0 + 1e-9) * speed) {
        return fmt::format("radius {:.3g} m, {:.3g} rooms a step: step {}: speed {:.12g} of the first one", radius,
                           advance / room, k, now / speed);
      }
    }
    return {};
  }));
}

/// Five balls with gaps of some steps' ways: impacts come one by one.
TYPED_TEST(Restitution, NewtonsCradle) {
  EXPECT_TRUE(NoneOf(100, 6000, [](Random& random) -> std::string {
    const double radius = random.LogUniform(1e-2, 1.0), dt = 1e-3, advance = radius * random.LogUniform(1e-3, 0.3),
                 speed = advance / dt;
    TypeParam scene(radius);
    double x = 0.0, way = 0.0;
    for (int i = 0; i < 5; ++i) {
      scene.AddDisk({x, 0.0}, radius, {i == 0 ? speed : 0.0, 0.0, 0.0}, {0.0, 1.0});
      const double gap = random.Uniform(3.0, 8.0) * advance;
      x += 2.0 * radius + gap;
      way += gap;
    }
    const int steps = static_cast<int>(way / advance) + 20;
    for (int k = 0; k < steps; ++k) scene.Step(dt);
    for (int i = 0; i < 5; ++i) {
      const double v = scene.velocity(i).vx / speed;
      if (!(std::abs(v - (i == 4 ? 1.0 : 0.0)) <= 1e-6)) {
        return fmt::format("{:.3g} radii a step: ball {} ends with {:.9g} of the first speed", advance / radius, i, v);
      }
    }
    return {};
  }));
}

double KineticEnergy(const Scene& scene) {
  double energy = 0.0;
  for (const auto& [id, grain] : scene.grains()) {
    const double r = grain.disks[0].radius, m = 3.14159265358979 * r * r;
    const Twist v = scene.velocity(id);
    energy += 0.5 * m * (v.vx * v.vx + v.vy * v.vy + 0.5 * r * r * v.spin * v.spin);
  }
  return energy;
}

/// A gas in a box, without gravity: with one e and no friction, or with friction and e = 0, energy does not grow.
TYPED_TEST(Restitution, EnergyNeverGrows) {
  EXPECT_TRUE(NoneOf(30, 7000, [](Random& random) -> std::string {
    const double radius = 0.1, dt = 0.01, half = 1.5, advance = radius * random.LogUniform(0.01, 3.0);
    const bool rough = random.Chance(0.3);
    const Material material{rough ? 0.5 : 0.0, rough ? 0.0 : random.OneOf({0.0, 0.3, 0.8, 1.0})};
    TypeParam scene(radius, {}, Exact(1e-12));
    scene.Add(Wall{.lines = {{{-half, -half}, {half, -half}},
                             {{half, -half}, {half, half}},
                             {{half, half}, {-half, half}},
                             {{-half, half}, {-half, -half}}},
                   .material = material});
    for (int i = 0; i < 36; ++i) {
      const Vec2 v = random.Uniform(0.0, 1.0) * advance / dt * random.Direction();
      scene.AddDisk({-1.1 + 0.44 * (i % 6), -1.1 + 0.44 * static_cast<double>(i / 6)}, radius * random.Uniform(0.5, 2.0),
                    {v.x, v.y, 0.0}, material);
    }
    double before = KineticEnergy(scene);
    for (int k = 1; k <= 100; ++k) {
      const bool is_solved = scene.Step(dt).solve.status == SolveStatus::kConverged;
      const double now = KineticEnergy(scene);
      // With friction a step need not have a solution that sweeps find; the report says so.
      if (rough && !is_solved) {
        before = now;
        continue;
      }
      if (now > before * (1.0 + (rough ? 1e-7 : 1e-10)) + 1e-30) {
        return fmt::format("e {}, mu {}, {:.3g} radii a step: step {} multiplies the energy by 1 + {:.3g}",
                           material.restitution, material.friction, advance / radius, k, now / before - 1.0);
      }
      before = now;
    }
    return {};
  }));
}

/// e = 0: whatever the phase and the speed, the disk stays on what it fell on.
TYPED_TEST(Restitution, NoneWithoutIt) {
  EXPECT_TRUE(NoneOf(300, 8000, [](Random& random) -> std::string {
    const double radius = random.LogUniform(1e-2, 1.0), dt = random.LogUniform(1e-4, 0.02),
                 advance = radius * random.LogUniform(1e-3, 20.0);
    TypeParam scene(radius);
    scene.SetGravity({0.0, -random.Uniform(0.0, 0.1) * advance / (dt * dt)});
    if (random.Chance(0.5)) {
      scene.AddFloor();
    } else {
      scene.AddLine({-20.0 * radius, 0.0}, {20.0 * radius, 0.0});
    }
    const auto disk = scene.AddDisk({0.0, radius + random.Uniform(0.0, 3.0) * advance}, radius, {0.0, -advance / dt, 0.0});
    for (int k = 1; k <= 20; ++k) {
      scene.Step(dt);
      const double v = scene.velocity(disk).vy * dt / advance;
      if (v > 1e-9)
        return fmt::format("{:.3g} radii a step: step {} rebounds with {:.3g} of the speed", advance / radius, k, v);
    }
    const double gap = scene.pose(disk).y / radius - 1.0, v = scene.velocity(disk).vy * dt / advance;
    return std::abs(v) < 1e-9 && std::abs(gap) < 1e-9
               ? ""
               : fmt::format("{:.3g} radii a step: ends {:.3g} radii above the floor, at {:.3g} of the speed", advance / radius,
                             gap, v);
  }));
}

/// e < 1 under gravity: it comes to rest, and a column at rest stays there.
TYPED_TEST(Restitution, ComesToRest) {
  for (const double e : {0.3, 0.6}) {
    TypeParam scene(0.5, {}, Exact());
    scene.SetGravity({0.0, -kG});
    scene.AddFloor(0.0, {0.0, e});
    const auto disk = scene.AddDisk({0.0, 1.5}, 0.5);
    for (int k = 0; k < 3000; ++k) scene.Step(2e-3);
    EXPECT_NEAR(scene.pose(disk).y, 0.5, 1e-6) << "e " << e;
    EXPECT_NEAR(scene.velocity(disk).vy, 0.0, 1e-6) << "e " << e;
  }
}

TYPED_TEST(Restitution, ColumnStaysAtRest) {
  for (const double e : {0.0, 0.5, 1.0}) {
    TypeParam scene(0.5, {}, Exact());
    scene.SetGravity({0.0, -kG});
    scene.AddFloor(0.0, {0.0, e});
    for (int i = 0; i < 10; ++i) scene.AddDisk({0.0, 0.5 + i}, 0.5, {}, {0.0, e});
    for (int k = 0; k < 200; ++k) scene.Step(0.01);
    for (int i = 1; i <= 10; ++i) {
      EXPECT_NEAR(scene.velocity(i).vy, 0.0, 1e-9) << "e " << e << ", disk " << i;
      EXPECT_NEAR(scene.pose(i).y, i - 0.5, 1e-9) << "e " << e << ", disk " << i;
    }
  }
}

}  // namespace
}  // namespace nscdd::contact_law
