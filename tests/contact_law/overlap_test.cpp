// SPDX-License-Identifier: Apache-2.0
// Bodies that overlap from the beginning: mended, or named by the report; never thrown apart.

#include <algorithm>
#include <cmath>
#include <string>

#include "bar.h"

namespace nscdd::contact_law {
namespace {

template <class S>
class Overlap : public testing::Test {};
TYPED_TEST_SUITE(Overlap, Platforms, PlatformNames);

/// Steps a scene at rest that begins with overlaps. At every step the report knows the deepest one, and nobody moves farther
/// than out of it.
std::string MendOrReport(Scene* scene, double dt, double radius) {
  const double first = Judge(*scene).depth * radius;
  for (int k = 1; k <= 200; ++k) {
    const StepReport& report = scene->Step(dt);
    const double depth = Judge(*scene).depth * radius;
    if (depth > 1e-3 * radius && report.max_interpenetration < 0.99 * depth) {
      return fmt::format("step {} leaves {:.3g} m of overlap, the report says {:.3g} m", k, depth, report.max_interpenetration);
    }
    if (depth > first + 1e-6 * radius) return fmt::format("step {}: overlap grows from {:.6g} m to {:.6g} m", k, first, depth);
  }
  for (const auto& [id, grain] : scene->grains()) {
    const Pose q = scene->pose(id);
    const double way = Norm(Centre(q) - Centre(grain.pose)) / radius;
    if (!(way < 4.0)) return fmt::format("body {} ends {:.3g} radii away", id, way);
  }
  return {};
}

TYPED_TEST(Overlap, TwoDisks) {
  for (const double overlap : {0.01, 0.3, 1.0, 1.9}) {
    for (const double e : {0.0, 0.5, 1.0}) {
      TypeParam scene(0.5);
      scene.AddDisk({0.0, 0.0}, 0.5, {}, {0.3, e});
      scene.AddDisk({1.0 - 0.5 * overlap, 0.0}, 0.5, {}, {0.3, e});
      EXPECT_EQ(MendOrReport(&scene, 0.01, 0.5), "") << "overlap " << overlap << " radii, e " << e;
    }
  }
}

TYPED_TEST(Overlap, CoincidentCentres) {
  for (const double e : {0.0, 1.0}) {
    TypeParam scene(0.5);
    scene.AddDisk({2.0, 1.0}, 0.5, {}, {0.3, e});
    scene.AddDisk({2.0, 1.0}, 0.5, {}, {0.3, e});
    EXPECT_EQ(MendOrReport(&scene, 0.01, 0.5), "") << "e " << e;
  }
}

/// 0.3 radii deep in walls of every kind, under gravity.
TYPED_TEST(Overlap, DiskInWalls) {
  for (int kind = 0; kind < (TypeParam::kHasPolygons ? 4 : 3); ++kind) {
    TypeParam scene(0.5);
    scene.SetGravity({0.0, -9.81});
    if (kind == 0) scene.AddFloor();
    if (kind == 1) scene.AddLine({-5.0, 0.0}, {5.0, 0.0});
    if (kind == 2) scene.Add(Wall{.pose = {0.0, -2.0, 0.0}, .disks = {{{}, 2.0}}});
    if (kind == 3) scene.Add(Wall{.polygons = {{{{-5.0, -2.0}, {5.0, -2.0}, {5.0, 0.0}, {-5.0, 0.0}}}}});
    scene.AddDisk({0.0, 0.35}, 0.5);
    EXPECT_EQ(MendOrReport(&scene, 0.01, 0.5), "") << "kind " << kind;
  }
}

/// A bouncing ball that is begun deep in the floor leaves with no more than it had.
TYPED_TEST(Overlap, ADeepStartGivesNoEnergy) {
  EXPECT_TRUE(NoneOf(100, 1000, [](Random& random) -> std::string {
    TypeParam scene(0.5);
    const double depth = random.Uniform(0.01, 1.0), e = random.OneOf({0.0, 0.5, 1.0});
    scene.AddDisk({0.0, 0.0}, 0.5, {0.0, 0.0, 0.0}, {0.0, e});
    const double speed = random.LogUniform(1e-2, 10.0);
    scene.AddDisk({1.0 - 0.5 * depth, 0.0}, 0.5, {-speed, 0.0, 0.0}, {0.0, e});
    for (int k = 1; k <= 50; ++k) {
      scene.Step(0.01);
      const double v = scene.velocity(0).vx, u = scene.velocity(1).vx;
      // Energy relative to that of the beginning.
      const double energy = (v * v + u * u) / (speed * speed);
      if (energy > 1.0 + 1e-9)
        return fmt::format("{:.3g} radii deep, e {}: step {} has {:.9g} of the first energy", depth, e, k, energy);
    }
    const double leaves = (scene.velocity(1).vx - scene.velocity(0).vx) / speed;
    return leaves > -1e-9
               ? ""
               : fmt::format("{:.3g} radii deep, e {}: they still approach, with {:.3g} of the speed", depth, e, -leaves);
  }));
}

}  // namespace
}  // namespace nscdd::contact_law
