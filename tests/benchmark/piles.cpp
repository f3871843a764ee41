// SPDX-License-Identifier: Apache-2.0
// How often a pyramid of six disks with friction 1 stands: Box2D's iterations are no measure of its answers' quality on piles.
//     build/release/bin/piles
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "scene/read_scene.h"
#include "tradeoff/contestant.h"

namespace nscdd::benchmark {
namespace {

constexpr int kStarts = 16;
constexpr double kRadius = 1.0;       // [m]
constexpr double kHighest = 0.02;     // [m] height above the ground from which the pyramid is let go; the starts divide it
constexpr double kSeconds = 10.0;     // that it must stand
constexpr double kTimeStep = 0.01;    // [s]
constexpr std::int64_t kTopBody = 6;  // the wall is body 0

/// Three, two and one disk whose shapes touch, all of them `height` too high.
Scene Pyramid(double height) {
  std::string text = fmt::format("[time]\ndt = {}\nsteps = 1\n[[materials]]\nname = \"m\"\nfriction = 1.0\n", kTimeStep) +
                     "[[walls]]\ntype = \"segments\"\npoints = [[-1000.0, 0.0], [1000.0, 0.0]]\n";
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 3 - row; ++i) {
      text += fmt::format("[[disks]]\ncentre = [{:.17f}, {:.17f}]\nradius = {}\n", kRadius * (2 * i + row - 2),
                          height + kRadius * (1.0 + std::sqrt(3.0) * row), kRadius);
    }
  }
  return ParseScene(text, "pyramid.toml");
}

/// Whether the top disk has sunk by less than its radius.
bool Stands(Contestant* contestant) {
  const auto height = [&] {
    BodyTable bodies;
    contestant->adapter().ReadBodies(&bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies.id[i] == kTopBody) return bodies.pose[i].y;
    }
    return 0.0;
  };
  const double before = height();
  contestant->SetGravity({0.0, -9.81});
  for (int k = 0; k < static_cast<int>(kSeconds / kTimeStep); ++k) contestant->Step(kTimeStep);
  return height() > before - kRadius;
}

void Count(const Setting& setting, const SolverRegistry& registry) {
  int standing = 0;
  for (int k = 0; k < kStarts; ++k) {
    const Scene scene = Pyramid(kHighest * k / kStarts);
    const auto contestant =
        setting.is_box2d() ? MakeBox2dContestant(scene, setting) : MakePluginContestant(scene, "box2d", registry, setting);
    standing += Stands(contestant.get());
  }
  fmt::print("{}: stands from {} of {} starts\n", setting.name, standing, kStarts);
}

void CountAll() {
  SolverRegistry registry;
  registry.Add(FindPlugin(""));
  for (const auto& [velocity, position] : {std::pair{"4", "2"}, {"8", "3"}, {"20", "10"}, {"50", "20"}, {"200", "50"}}) {
    Count({fmt::format("Box2D {}/{}", velocity, position),
           "box2d",
           {{"velocity_iterations", velocity}, {"position_iterations", position}}},
          registry);
  }
  for (const std::string tolerance : {"1e-2", "1e-4"})
    Count({"nscd nat " + tolerance, "nscd", {{"tolerance", tolerance}}}, registry);
}

}  // namespace
}  // namespace nscdd::benchmark

int main() {
  try {
    nscdd::benchmark::CountAll();
  } catch (const std::exception& e) {
    fmt::print(stderr, "piles: {}\n", e.what());
    return 1;
  }
}
