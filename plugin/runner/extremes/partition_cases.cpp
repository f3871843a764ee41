// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "extremes/extreme_case.h"
#include "extremes/scenes.h"

namespace nscdd {
namespace {

/// A disk in flight, hit from all sides alike: it flies on, and the petals with it. All its contacts lie in subdomains of their
/// own.
void BuildFlower(int petals, reference::World* world) {
  constexpr double kCentre = 4.0, kPetal = 0.5;
  const Vec2 flight{0.3, 0.1};
  reference::Body& centre = AddGrain(world, 0, {}, kCentre);
  centre.velocity = {flight.x, flight.y, 0.0};
  for (int k = 0; k < petals; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.5) / petals;
    const Vec2 n{std::cos(angle), std::sin(angle)};
    // Shifted so that they touch at the middle of the step, when the contacts are sought.
    reference::Body& petal = AddGrain(world, k + 1, (kCentre + kPetal + 0.005) * n, kPetal);
    petal.velocity = {flight.x - n.x, flight.y - n.y, 0.0};
  }
}

ExtremeCase Make(const std::string& family, const std::string& name, const std::string& subdomains, const Pile& pile) {
  ExtremeCase c{.family = family, .name = name, .build = [pile](reference::World* w) { BuildPile(pile, w); }};
  c.subdomains = subdomains;
  return c;
}

}  // namespace

std::vector<ExtremeCase> PartitionCases() {
  std::vector<ExtremeCase> cases;
  for (const double lambda : {0.0, 1.0, 1e2, 1e4, 1e6, 1e8, 1e12}) {
    cases.push_back(Make("lambda", fmt::format("pile, lambda {:g}", lambda), "2x2", {.friction = 0.3}));
    cases.back().options = {{"lambda", fmt::format("{}", lambda)}};
    cases.back().only_with = "lambda";
    cases.back().lambda = lambda;
    cases.back().quick = lambda == 0.0 || lambda >= 1e8;
  }
  for (const char* grid : {"1x1", "1x4", "1x40", "40x40"}) {
    ExtremeCase c{.family = "subdomains", .name = fmt::format("column of 40, {}", grid), .build = [](reference::World* w) {
                    BuildStack(std::vector<Grain>(40), 0.0, {}, w);
                  }};
    c.subdomains = grid;
    c.extent = 40.0;
    cases.push_back(c);
  }
  for (const char* grid : {"1x1", "2x2", "8x8", "40x40"}) {
    cases.push_back(Make("subdomains", fmt::format("pile, {}", grid), grid, {.friction = 0.3}));
    cases.back().quick = std::string(grid) == "8x8" || std::string(grid) == "40x40";
  }
  for (const char* grid : {"4x4", "16x16"}) {
    ExtremeCase c{.family = "subdomains",
                  .name = fmt::format("a disk shared by all, {}", grid),
                  .build = [](reference::World* w) { BuildFlower(16, w); }};
    c.truth = [](std::int64_t) { return Twist{0.3, 0.1, 0.0}; };
    c.scale = 1.0;
    c.subdomains = grid;
    c.quick = true;
    cases.push_back(c);
  }
  return cases;
}

}  // namespace nscdd
