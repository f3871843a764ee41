// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/gravity.h"
#include "scene/read_scene.h"
#include "scene_files.h"

namespace nscdd {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(SceneGravity, ConstantStays) {
  const GravityLaw law = ConstantGravity{{1.0, -2.0}};
  for (const int step : {1, 2, 1000}) {
    EXPECT_EQ(GravityAt(law, step, 0.1).x, 1.0);
    EXPECT_EQ(GravityAt(law, step, 0.1).y, -2.0);
  }
}

TEST(SceneGravity, RotationReachesBothAnglesAtItsEndsAndIsLinear) {
  const GravityLaw law = RotatingGravity{9.81, kPi / 8, -kPi / 8, 50, 0.0};
  for (int step = 1; step <= 60; ++step) {
    const double angle = step >= 50 ? -kPi / 8 : kPi / 8 - kPi / 4 * (step - 1) / 49.0;
    const Vec2 g = GravityAt(law, step, 0.01);
    EXPECT_NEAR(g.x, 9.81 * std::sin(angle), 1e-14) << step;
    EXPECT_NEAR(g.y, -9.81 * std::cos(angle), 1e-14) << step;
  }
}

TEST(SceneGravity, RotationInTimeIsThatOfTheStepsBeginning) {
  const GravityLaw law = RotatingGravity{9.81, 0.0, 1.0, {}, 0.4};
  EXPECT_EQ(GravityAt(law, 1, 0.1).x, 0.0);
  EXPECT_NEAR(GravityAt(law, 3, 0.1).x, 9.81 * std::sin(0.5), 1e-14);
  EXPECT_NEAR(GravityAt(law, 5, 0.1).x, 9.81 * std::sin(1.0), 1e-14);
  EXPECT_NEAR(GravityAt(law, 50, 0.1).x, 9.81 * std::sin(1.0), 1e-14);
}

TEST(SceneGravity, TableIsLinearBetweenSamplesAndHeldOutside) {
  const GravityLaw law = GravityTable{{{0.1, {0.0, -10.0}}, {0.3, {4.0, -6.0}}, {0.4, {0.0, 0.0}}}};
  EXPECT_EQ(GravityAt(law, 1, 0.05).y, -10.0);
  EXPECT_NEAR(GravityAt(law, 5, 0.05).x, 2.0, 1e-14);
  EXPECT_NEAR(GravityAt(law, 5, 0.05).y, -8.0, 1e-14);
  EXPECT_NEAR(GravityAt(law, 8, 0.05).y, -3.0, 1e-14);
  EXPECT_EQ(GravityAt(law, 9, 0.05).x, 0.0);
  EXPECT_EQ(GravityAt(law, 1000, 0.05).y, 0.0);
}

TEST(SceneGravity, RotatingBoxTurnsFromPiOver8ToMinusPiOver8In50Steps) {
  const Scene scene = ReadSceneFile(SampleScenes() / "rotating_box_730.toml");
  EXPECT_EQ(scene.time.steps, 50);
  EXPECT_NEAR(GravityAt(scene.gravity, 1, scene.time.dt).x, 9.81 * std::sin(kPi / 8), 1e-14);
  EXPECT_NEAR(GravityAt(scene.gravity, 50, scene.time.dt).x, -9.81 * std::sin(kPi / 8), 1e-14);
  EXPECT_NEAR(GravityAt(scene.gravity, 51, scene.time.dt).y, -9.81 * std::cos(kPi / 8), 1e-14);
}

TEST(SceneGravity, SlopeTiltsByPiOver6) {
  const Scene scene = ReadSceneFile(SampleScenes() / "sloped_flow_750.toml");
  EXPECT_NEAR(GravityAt(scene.gravity, 1, scene.time.dt).x, -9.81 * 0.5, 1e-14);
  EXPECT_NEAR(GravityAt(scene.gravity, 200, scene.time.dt).y, -9.81 * std::sqrt(0.75), 1e-14);
}

}  // namespace
}  // namespace nscdd
