// SPDX-License-Identifier: Apache-2.0
// A scene pays for what it has: second solves for rebounds, new detections for what went where nobody expected it, candidates
// for the bodies that are fast.

#include <cstdint>

#include "bar.h"

namespace nscdd::contact_law {
namespace {

constexpr double kG = 9.81;

template <class S>
class Counters : public testing::Test {};
TYPED_TEST_SUITE(Counters, Platforms, PlatformNames);

/// Figures of the report, -1 where it has none.
template <class Report>
std::int64_t SecondSolves(const Report& report) {
  if constexpr (requires { report.second_solves; }) return report.second_solves;
  return -1;
}
template <class Report>
std::int64_t Redetections(const Report& report) {
  if constexpr (requires { report.redetections; }) return report.redetections;
  return -1;
}

/// A square pile of touching disks in a box, at rest.
void AddPile(int columns, int rows, Material material, Scene* scene) {
  const double width = columns, height = rows + 5.0;
  scene->SetGravity({0.0, -kG});
  scene->Add(Wall{.lines = {{{0.0, height}, {0.0, 0.0}}, {{0.0, 0.0}, {width, 0.0}}, {{width, 0.0}, {width, height}}},
                  .material = material});
  for (int k = 0; k < columns * rows; ++k) scene->AddDisk({0.5 + k % columns, 0.5 + k / columns}, 0.5, {}, material);
}

TYPED_TEST(Counters, NoSecondSolveWithoutRestitution) {
  TypeParam scene(0.5);
  AddPile(6, 6, {0.3, 0.0}, &scene);
  const auto falls = scene.AddDisk({3.1, 9.0}, 0.5, {1.0, -3.0, 0.0}, {0.3, 0.0});
  bool hit = false;
  for (int k = 1; k <= 100; ++k) {
    const StepReport& report = scene.Step(0.01);
    ASSERT_EQ(SecondSolves(report), 0) << "step " << k;
    hit = hit || scene.velocity(falls).vy > -2.0;
  }
  EXPECT_TRUE(hit) << "a test of impacts without any";
}

TYPED_TEST(Counters, OneSecondSolveWhereSomethingRebounds) {
  TypeParam scene(0.5);
  scene.SetGravity({0.0, -kG});
  scene.AddFloor(0.0, {0.0, 0.8});
  scene.AddDisk({0.0, 2.5}, 0.5);
  int solves = 0;
  for (int k = 1; k <= 100; ++k) {
    const std::int64_t now = SecondSolves(scene.Step(0.01));
    ASSERT_GE(now, 0) << "the report has no figure second_solves";
    solves += static_cast<int>(now);
  }
  EXPECT_EQ(solves, 1) << "one impact in a second of fall from 2 m";
}

TYPED_TEST(Counters, NothingIsDetectedTwiceAtRest) {
  TypeParam scene(0.5);
  AddPile(6, 6, {0.3, 0.5}, &scene);
  for (int k = 1; k <= 20; ++k) ASSERT_EQ(Redetections(scene.Step(0.01)), 0) << "step " << k;
}

/// Reach is a body's own: one that flies past at 20 radii a step makes no candidates among those at rest.
TYPED_TEST(Counters, CandidatesOfAFastBodyAreItsOwn) {
  TypeParam without(0.5), with(0.5);
  for (Scene* scene : {static_cast<Scene*>(&without), static_cast<Scene*>(&with)}) AddPile(10, 10, {0.3, 0.0}, scene);
  with.AddDisk({5.0, 40.0}, 0.5, {500.0, 1000.0, 0.0});
  for (int k = 1; k <= 3; ++k) {
    const std::int64_t quiet = without.Step(0.01).solve.contacts, fast = with.Step(0.01).solve.contacts;
    EXPECT_EQ(fast, quiet) << "step " << k;
    EXPECT_LE(quiet, 10 * 9 + 9 * 10 + 10 + 10 + 10) << "touching pairs and walls; the nearest others are 0.4 radii apart";
  }
}

}  // namespace
}  // namespace nscdd::contact_law
