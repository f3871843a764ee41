// SPDX-License-Identifier: Apache-2.0
// A pair that does not meet before the next detection does nothing, and the joints of one floor are no corners.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bar.h"

namespace nscdd::contact_law {
namespace {

constexpr double kG = 9.81;

template <class S>
class NothingEarly : public testing::Test {};
TYPED_TEST_SUITE(NothingEarly, Platforms, PlatformNames);

bool SameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool SameBits(const Twist& a, const Twist& b) {
  return SameBits(a.vx, b.vx) && SameBits(a.vy, b.vy) && SameBits(a.spin, b.spin);
}

/// One flight past something, without loads.
struct Flight {
  explicit Flight(Random* random)
      : radius(random->LogUniform(1e-3, 10.0)),
        dt(random->LogUniform(1e-4, 0.05)),
        advance(radius * (random->Chance(0.5) ? random->LogUniform(1e-2, 20.0) : random->Uniform(0.0, 2.0))),
        clearance(random->LogUniform(1e-6, 0.5)),
        direction(random->Direction()),
        across(random->Sign() * Vec2{-direction.y, direction.x}),
        spin(random->Uniform(-1.0, 1.0) / dt),
        begin(random->Uniform(0.0, 4.0) * advance) {}
  Vec2 velocity() const { return (advance / dt) * direction; }
  /// Where a disk begins whose centre comes to within `distance` of the origin, across the path.
  Vec2 Begin(double distance) const { return distance * across - begin * direction; }

  double radius, dt;
  double advance;    ///< [m] that a step covers
  double clearance;  ///< [-] in radii
  Vec2 direction, across;
  double spin;
  double begin;  ///< [m] along the path before the closest approach
};

const Material kRough{0.5, 0.5};

/// Steps, and says who changed its velocity.
std::string Watch(const Flight& flight, int steps, Scene* scene) {
  for (int k = 1; k <= steps; ++k) {
    scene->Step(flight.dt);
    for (const auto& [id, grain] : scene->grains()) {
      const Twist v = scene->velocity(id), u = grain.velocity;
      if (!SameBits(v, u)) {
        return fmt::format("clearance {:.3g} radii, {:.3g} radii a step: step {} changes ({}, {}, {}) to ({}, {}, {})",
                           flight.clearance, flight.advance / flight.radius, k, u.vx, u.vy, u.spin, v.vx, v.vy, v.spin);
      }
    }
  }
  return {};
}

TYPED_TEST(NothingEarly, PastTheEndOfASegment) {
  EXPECT_TRUE(NoneOf(300, 1000, [](Random& random) {
    const Flight f(&random);
    TypeParam scene(f.radius);
    const Vec2 along = Rotate(random.Uniform(-1.57, 1.57), -1.0 * f.across);  // away from the path
    scene.AddLine({}, random.Uniform(0.1, 10.0) * f.radius * along, kRough);
    const Vec2 v = f.velocity();
    scene.AddDisk(f.Begin((1.0 + f.clearance) * f.radius), f.radius, {v.x, v.y, f.spin}, kRough);
    return Watch(f, 8, &scene);
  }));
}

/// A convex corner: of a polygon, or of two segments.
TYPED_TEST(NothingEarly, PastACorner) {
  EXPECT_TRUE(NoneOf(300, 2000, [](Random& random) {
    const Flight f(&random);
    TypeParam scene(f.radius);
    const double size = random.Uniform(0.1, 10.0) * f.radius, open = random.Uniform(0.2, 1.4);
    const double lean = random.Uniform(-1.5 + open, 1.5 - open);
    const Vec2 one = size * Rotate(lean - open, -1.0 * f.across), other = size * Rotate(lean + open, -1.0 * f.across);
    if (TypeParam::kHasPolygons) {
      scene.Add(Wall{.polygons = {{{{}, one, other}}}, .material = kRough});
    } else {
      scene.Add(Wall{.lines = {{one, {}}, {{}, other}}, .material = kRough});
    }
    const Vec2 v = f.velocity();
    scene.AddDisk(f.Begin((1.0 + f.clearance) * f.radius), f.radius, {v.x, v.y, f.spin}, kRough);
    return Watch(f, 8, &scene);
  }));
}

TYPED_TEST(NothingEarly, PastAnotherDisk) {
  EXPECT_TRUE(NoneOf(300, 3000, [](Random& random) {
    const Flight f(&random);
    TypeParam scene(f.radius);
    const double other = f.radius * random.LogUniform(0.1, 10.0);
    const Vec2 v = f.velocity();
    const bool fixed = random.Chance(0.3);
    // Both may move: their ways may cross, but they are there at different times.
    const Vec2 common = fixed ? Vec2{} : random.Uniform(0.0, 10.0) * f.radius / f.dt * random.Direction();
    if (fixed) {
      scene.Add(Wall{.disks = {{{}, other}}, .material = kRough});
    } else {
      scene.AddDisk({}, other, {common.x, common.y, -f.spin}, kRough);
    }
    const Vec2 u = v + common;
    scene.AddDisk(f.Begin(f.radius + other + f.clearance * std::min(f.radius, other)), f.radius, {u.x, u.y, f.spin}, kRough);
    return Watch(f, 8, &scene);
  }));
}

TYPED_TEST(NothingEarly, AlongAHalfPlane) {
  EXPECT_TRUE(NoneOf(300, 4000, [](Random& random) {
    const Flight f(&random);
    TypeParam scene(f.radius);
    // Rounding of the direction may not lead into the plane within the eight steps.
    const double height = f.radius * (1.0 + f.clearance) + 1e-12 * f.advance;
    scene.Add(Wall{.planes = {{f.across, 0.0}}, .material = kRough});
    const Vec2 v = f.velocity();
    scene.AddDisk(f.Begin(height), f.radius, {v.x, v.y, f.spin}, kRough);
    return Watch(f, 8, &scene);
  }));
}

/// Falling on a wall, as long as it is not reached: up to `clearance` before it.
TYPED_TEST(NothingEarly, NotYetThere) {
  EXPECT_TRUE(NoneOf(300, 5000, [](Random& random) {
    const Flight f(&random);
    TypeParam scene(f.radius);
    const Vec2 normal = Rotate(random.Uniform(-1.2, 1.2), -1.0 * f.direction);
    const int kind = random.Below(TypeParam::kHasPolygons ? 3 : 2), steps = 1 + random.Below(5);
    const Vec2 along{normal.y, -normal.x};
    const double size = 300.0 * f.radius;
    Wall wall{.material = kRough};
    if (kind == 0) wall.planes = {{normal, 0.0}};
    if (kind == 1) wall.lines = {{size * along, -size * along}};
    if (kind == 2)
      wall.polygons = {{{-size * along, -size * along - f.radius * normal, size * along - f.radius * normal, size * along}}};
    scene.Add(wall);
    const Vec2 begin = (1.0 + f.clearance) * f.radius * normal - steps * f.advance * f.direction, v = f.velocity();
    scene.AddDisk(begin, f.radius, {v.x, v.y, f.spin}, kRough);
    return Watch(f, steps, &scene);
  }));
}

/// The distance that a cluster keeps from the disk of radius `other` at the origin while it flies and turns.
double ClosestApproach(const Grain& grain, double time, double other) {
  constexpr int kSamples = 20000;
  double closest = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kSamples; ++k) {
    const Pose pose = Moved(grain.pose, grain.velocity, time * k / kSamples);
    for (const Circle& disk : grain.disks) closest = std::min(closest, Norm(InWorld(pose, disk.centre)) - disk.radius - other);
  }
  return closest;
}

/// A dumb-bell that turns by up to one radian a step past a fixed disk.
TYPED_TEST(NothingEarly, TurningClusterPastADisk) {
  EXPECT_TRUE(NoneOf(300, 6000, [](Random& random) -> std::string {
    Flight f(&random);
    f.advance = std::min(f.advance, 3.0 * f.radius);
    f.begin = random.Uniform(0.0, 4.0) * f.advance;
    const Vec2 v = f.velocity();
    Grain grain{.velocity = {v.x, v.y, f.spin},
                .disks = {{{-f.radius, 0.0}, f.radius}, {{f.radius, 0.0}, f.radius}},
                .material = kRough};
    const double angle = random.Uniform(-3.0, 3.0), other = f.radius * random.Uniform(0.2, 3.0);
    double away = 0.0;
    for (double near = 0.0, far = 3.0 * f.radius + other; far - near > 1e-3 * f.radius;) {  // closest without touching
      away = 0.5 * (near + far);
      const Vec2 at = f.Begin(away);
      grain.pose = {at.x, at.y, angle};
      (ClosestApproach(grain, 6 * f.dt, other) > f.radius * 1e-4 ? far : near) = away;
      away = far;
    }
    const Vec2 at = f.Begin(away);
    grain.pose = {at.x, at.y, angle};
    f.clearance = ClosestApproach(grain, 6 * f.dt, other) / f.radius;
    if (f.clearance < 1e-5) return {};  // begins in the disk
    TypeParam scene(f.radius);
    scene.Add(Wall{.disks = {{{}, other}}, .material = kRough});
    scene.Add(grain);
    return Watch(f, 6, &scene);
  }));
}

/// A throw under gravity over the end of a segment: the same bits as without the segment.
TYPED_TEST(NothingEarly, ThrownOverASegment) {
  int thrown = 0;
  EXPECT_TRUE(NoneOf(2000, 7000, [&](Random& random) -> std::string {
    const Flight f(&random);
    const Vec2 g{0.0, -random.Uniform(0.0, 0.5) * f.radius / (f.dt * f.dt)}, v = f.velocity();
    const Vec2 middle = 3.0 * f.advance * f.direction + random.Uniform(-3.0, 3.0) * f.radius * f.across;
    const Line line{middle, middle + random.Uniform(0.1, 10.0) * f.radius * random.Direction()};
    // The scheme's own way without contact: chords of the trapezoidal rule.
    double closest = std::numeric_limits<double>::infinity();
    Vec2 x{}, u = v;
    for (int k = 0; k < 8; ++k) {
      const Vec2 next_u = u + f.dt * g, next = x + 0.5 * f.dt * (u + next_u);
      closest = std::min({closest, Passes(x, next, line) ? 0.0 : Distance(next, line), Distance(x, line),
                          Distance(line.a, Line{x, next}), Distance(line.b, Line{x, next})});
      x = next;
      u = next_u;
    }
    if (closest < (1.0 + 1e-6) * f.radius || closest > 1.5 * f.radius) return {};
    ++thrown;
    TypeParam with(f.radius), without(f.radius);
    with.AddLine(line.a, line.b, kRough);
    without.AddLine({1e6 * f.radius, 0.0}, {1.1e6 * f.radius, 0.0}, kRough);
    for (Scene* scene : {static_cast<Scene*>(&with), static_cast<Scene*>(&without)}) {
      scene->SetGravity(g);
      scene->AddDisk({}, f.radius, {v.x, v.y, f.spin}, kRough);
    }
    for (int k = 1; k <= 8; ++k) {
      with.Step(f.dt);
      without.Step(f.dt);
      const Pose q = with.pose(1), p = without.pose(1);
      if (!SameBits(q.x, p.x) || !SameBits(q.y, p.y)) {
        return fmt::format("clearance {:.3g} radii: step {} ends {:.3g} radii beside the way without the wall",
                           closest / f.radius - 1.0, k, Norm(Centre(q) - Centre(p)) / f.radius);
      }
      if (!SameBits(with.velocity(1), without.velocity(1))) {
        return fmt::format("clearance {:.3g} radii, {:.3g} radii a step: step {}: ({}, {}) and without the wall ({}, {})",
                           closest / f.radius - 1.0, f.advance / f.radius, k, with.velocity(1).vx, with.velocity(1).vy,
                           without.velocity(1).vx, without.velocity(1).vy);
      }
    }
    return {};
  }));
  EXPECT_GT(thrown, 100) << "a test of flights without any";
}

/// Coplanar pieces from x = 0 on, each a body with a friction of its own; solid below.
std::vector<double> AddPieces(int count, double radius, bool polygons, Random* random, Scene* scene, double smallest = 0.2,
                              double largest = 3.0, double friction = 1.0) {
  std::vector<double> ends{0.0};
  for (int i = 0; i < count; ++i) {
    const double a = ends.back(), b = a + radius * (i == 0 || i + 1 == count ? 10.0 : random->Uniform(smallest, largest));
    const Material material{friction * random->Uniform(1.0, 3.0), 0.0};
    if (polygons) {
      scene->Add(Wall{.polygons = {{{{a, 0.0}, {a, -radius}, {b, -radius}, {b, 0.0}}}}, .material = material});
    } else if (random->Chance(0.5)) {
      scene->AddLine({a, 0.0}, {b, 0.0}, material);
    } else {
      scene->AddLine({b, 0.0}, {a, 0.0}, material);
    }
    ends.push_back(b);
  }
  return ends;
}

/// Rolls at 4 m/s over a level floor of pieces, either way.
template <class S>
std::string RollOverJoints(int pieces, bool polygons, Random& random) {
  const double radius = random.Uniform(0.1, 1.0), dt = random.OneOf({1e-3, 1e-2, 0.03});
  S scene(radius);
  scene.SetGravity({0.0, -kG});
  const double length = AddPieces(pieces, radius, polygons, &random, &scene).back();
  const double sign = random.Sign(), x = sign > 0.0 ? 5.0 * radius : length - 5.0 * radius;
  const auto disk = scene.AddDisk({x, radius}, radius, {4.0 * sign, 0.0, -4.0 * sign / radius}, {0.5, 0.0});
  const int steps = static_cast<int>((length - 12.0 * radius) / (4.0 * dt));
  for (int k = 1; k <= steps; ++k) {
    scene.Step(dt);
    const Twist v = scene.velocity(disk);
    if (!(std::abs(v.vx - 4.0 * sign) <= 1e-12 && std::abs(v.vy) <= 1e-12 && std::abs(v.spin * radius + 4.0 * sign) <= 1e-12)) {
      return fmt::format("radius {:.3g} m, dt {} s: after {} steps v = ({:.17g}, {:.3g}) m/s, R w = {:.17g} m/s at x = {:.17g}",
                         radius, dt, k, v.vx, v.vy, v.spin * radius, scene.pose(disk).x);
    }
  }
  return {};
}

TYPED_TEST(NothingEarly, JointOfTwoPieces) {
  EXPECT_TRUE(NoneOf(100, 8000, [](Random& random) { return RollOverJoints<TypeParam>(2, false, random); }));
}

TYPED_TEST(NothingEarly, JointsOfManyPieces) {
  EXPECT_TRUE(NoneOf(30, 9000, [](Random& random) { return RollOverJoints<TypeParam>(30, false, random); }));
}

TYPED_TEST(NothingEarly, JointsOfPolygons) {
  if (!TypeParam::kHasPolygons) GTEST_SKIP() << "no polygons on this platform";
  EXPECT_TRUE(NoneOf(30, 10000, [](Random& random) { return RollOverJoints<TypeParam>(10, true, random); }));
}

/// A segment that lies on a half-plane: its end is no corner.
TYPED_TEST(NothingEarly, SegmentOnAHalfPlane) {
  TypeParam scene(0.5);
  scene.SetGravity({0.0, -kG});
  scene.AddFloor(0.0, {0.5, 0.0});
  scene.AddLine({0.0, 0.0}, {1.0, 0.0}, {0.5, 0.0});
  const auto disk = scene.AddDisk({-1.0, 0.5}, 0.5, {4.0, 0.0, -8.0}, {0.5, 0.0});
  for (int k = 1; k <= 100; ++k) {
    scene.Step(0.01);
    ASSERT_NEAR(scene.velocity(disk).vx, 4.0, 1e-12) << "step " << k;
    ASSERT_NEAR(scene.velocity(disk).vy, 0.0, 1e-12) << "step " << k;
  }
}

/// Slides from a smooth piece onto a rough one: only there it is braked, by mu g.
TYPED_TEST(NothingEarly, PiecesKeepTheirFriction) {
  for (const double mu : {0.1, 0.3}) {
    TypeParam scene(0.5, {}, Exact());
    scene.SetGravity({0.0, -kG});
    scene.AddLine({-10.0, 0.0}, {0.0, 0.0}, {0.0, 0.0});
    scene.AddLine({0.0, 0.0}, {20.0, 0.0}, {mu * mu, 0.0});
    const auto disk = scene.AddDisk({-1.0, 0.5}, 0.5, {5.0, 0.0, 0.0}, {1.0, 0.0});
    const double dt = 1e-3, braked = 0.3 * 5.0 / (mu * kG);  // [s], before it rolls
    double time = 0.0;
    while (time < 0.2 + braked) {
      scene.Step(dt);
      time += dt;
      const double expected = 5.0 - mu * kG * std::max(0.0, time - 0.2);
      ASSERT_NEAR(scene.velocity(disk).vx, expected, 1.5 * mu * kG * dt) << "mu " << mu << ", time " << time;
      if (time < 0.199) {
        ASSERT_NEAR(scene.velocity(disk).vx, 5.0, 1e-12) << "time " << time;
      }
    }
  }
}

/// Falls beside the joint: the piece below it says with which restitution.
TYPED_TEST(NothingEarly, PiecesKeepTheirRestitution) {
  for (const double x : {-0.02, 0.02}) {
    TypeParam scene(0.5, {}, Exact());
    scene.SetGravity({0.0, -kG});
    scene.AddLine({-10.0, 0.0}, {0.0, 0.0}, {0.0, 0.8});
    scene.AddLine({0.0, 0.0}, {10.0, 0.0}, {0.0, 0.0});
    const auto disk = scene.AddDisk({x, 1.5}, 0.5);
    double up = 0.0;
    for (int k = 1; k <= 700; ++k) {
      scene.Step(1e-3);
      up = std::max(up, scene.velocity(disk).vy);
    }
    EXPECT_NEAR(up, x < 0.0 ? 0.8 * std::sqrt(2.0 * kG) : 0.0, x < 0.0 ? 3.0 * kG * 1e-3 : 1e-9) << "x " << x;
    EXPECT_NEAR(scene.velocity(disk).vx, 0.0, 1e-12) << "x " << x;
  }
}

/// 30 coplanar pieces, inclined by `angle`, friction `mu`; R w and v against their closed forms, x to the step that an implicit
/// rule is ahead.
template <class S>
std::string GoDown(double angle, double mu, std::uint64_t seed) {
  Random random(seed);
  const double radius = 0.5, dt = 4e-3;
  S scene(radius, {}, Exact());
  scene.SetGravity({kG * std::sin(angle), -kG * std::cos(angle)});
  // Every piece has the friction mu^2 / its disk's 1 or more: rolling needs no more than tan(angle) / 3.
  const bool rolls = mu >= std::tan(angle) / 3.0;
  const double length = AddPieces(30, radius, false, &random, &scene, 0.3, 3.0, rolls ? mu * mu : 0.0).back();
  if (!rolls && mu > 0.0) ADD_FAILURE() << "use SlideDown";
  const auto disk = scene.AddDisk({5.0 * radius, radius}, radius, {}, {1.0, 0.0});
  const double a = (mu > 0.0 ? 2.0 / 3.0 : 1.0) * kG * std::sin(angle);
  for (int k = 1;; ++k) {
    scene.Step(dt);
    const double t = k * dt, v = a * t, x = 5.0 * radius + 0.5 * a * t * t;
    if (x > length - 6.0 * radius) return {};
    const Twist is = scene.velocity(disk);
    const double spin = mu > 0.0 ? -v : 0.0;
    if (!(std::abs(is.vx - v) <= 1e-6 * v && std::abs(is.spin * radius - spin) <= 1e-6 * v &&
          std::abs(scene.pose(disk).x - x) <= v * dt && std::abs(is.vy) <= 1e-6 * v)) {
      return fmt::format("angle {}, mu {}: after {} steps v = {:.9g} m/s, not {:.9g}; R w = {:.9g}; x = {:.9g} m, not {:.9g}",
                         angle, mu, k, is.vx, v, is.spin * radius, scene.pose(disk).x, x);
    }
  }
}

TYPED_TEST(NothingEarly, RollsDownThirtyPieces) {
  for (const double angle : {0.05, 0.3, 0.8}) EXPECT_EQ(GoDown<TypeParam>(angle, 0.6, 11000), "");
}

TYPED_TEST(NothingEarly, SlidesDownThirtySmoothPieces) {
  for (const double angle : {0.05, 0.3, 0.8}) EXPECT_EQ(GoDown<TypeParam>(angle, 0.0, 12000), "");
}

/// mu below tan(angle) / 3: v' = g (sin a - mu cos a), R w' = -2 mu g cos a.
TYPED_TEST(NothingEarly, SlidesDownThirtyRoughPieces) {
  for (const double angle : {0.3, 0.8}) {
    const double radius = 0.5, dt = 4e-3, mu = 0.15 * std::tan(angle);
    TypeParam scene(radius, {}, Exact());
    scene.SetGravity({kG * std::sin(angle), -kG * std::cos(angle)});
    Random random(13000);
    double end = 0.0;
    for (int i = 0; i < 30; ++i) {
      const double next = end + random.Uniform(0.3, 3.0) * radius + (i == 0 ? 10.0 * radius : 0.0);
      scene.AddLine({end, 0.0}, {next, 0.0}, {mu, 0.0});
      end = next;
    }
    const auto disk = scene.AddDisk({5.0 * radius, radius}, radius, {}, {mu, 0.0});
    const double a = kG * (std::sin(angle) - mu * std::cos(angle)), w = -2.0 * mu * kG * std::cos(angle);
    for (int k = 1;; ++k) {
      scene.Step(dt);
      const double t = k * dt;
      if (5.0 * radius + 0.5 * a * t * t > end - radius) break;
      ASSERT_NEAR(scene.velocity(disk).vx, a * t, 1e-6 * a * t) << "angle " << angle << ", step " << k;
      ASSERT_NEAR(scene.velocity(disk).spin * radius, w * t, 1e-6 * a * t) << "angle " << angle << ", step " << k;
      ASSERT_NEAR(scene.pose(disk).x, 5.0 * radius + 0.5 * a * t * t, 1.001 * a * t * dt)
          << "angle " << angle << ", step " << k;
    }
  }
}

/// A level floor: v = v_0 - mu g t until it rolls at 2/3 v_0.
TYPED_TEST(NothingEarly, SlidesUntilItRolls) {
  const double radius = 0.5, dt = 2e-3, mu = 0.2, v0 = 6.0;
  TypeParam scene(radius, {}, Exact());
  scene.SetGravity({0.0, -kG});
  for (int i = 0; i < 60; ++i) scene.AddLine({0.5 * i, 0.0}, {0.5 * (i + 1), 0.0}, {mu, 0.0});
  const auto disk = scene.AddDisk({1.0, radius}, radius, {v0, 0.0, 0.0}, {mu, 0.0});
  const double rolls = v0 / (3.0 * mu * kG);
  for (int k = 1; k * dt < 2.0 * rolls; ++k) {
    scene.Step(dt);
    const double t = k * dt, v = scene.velocity(disk).vx;
    if (t < rolls) {
      ASSERT_NEAR(v, v0 - mu * kG * t, 1e-6 * v0) << "step " << k;
    } else if (t > rolls + dt) {
      ASSERT_NEAR(v, 2.0 / 3.0 * v0, 1e-6 * v0) << "step " << k;
    }
  }
}

}  // namespace
}  // namespace nscdd::contact_law
