// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "extremes/extreme_case.h"
#include "extremes/scenes.h"

namespace nscdd {
namespace {

ExtremeCase RestingPile(const std::string& family, const std::string& name, const Pile& pile) {
  ExtremeCase c{.family = family, .name = name, .build = [pile](reference::World* world) { BuildPile(pile, world); }};
  c.extent = std::abs(pile.origin.x) + std::abs(pile.origin.y) + 20.0 * pile.radius;
  return c;
}

}  // namespace

std::vector<ExtremeCase> ScaleCases() {
  std::vector<ExtremeCase> cases;
  for (const double dt : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    ExtremeCase c = RestingPile("time step", fmt::format("pile, dt {:g} s", dt), {.friction = 0.3});
    c.dt = dt;
    c.scale = kGravity * dt;
    c.quick = dt == 1e-5 || dt == 1.0;
    cases.push_back(c);
  }
  // Lengths by L, times by sqrt(L): the same problem in other units, gravity unchanged.
  for (const double length : {1e-6, 1e-3, 1.0, 1e3}) {
    ExtremeCase c =
        RestingPile("units", fmt::format("pile, radius {:g} m", 0.5 * length), {.radius = 0.5 * length, .friction = 0.3});
    c.dt = 0.01 * std::sqrt(length);
    c.scale = kGravity * c.dt;
    c.quick = length == 1e-6 || length == 1e3;
    cases.push_back(c);
  }
  for (const double radii : {1e3, 1e6, 1e9}) {
    cases.push_back(RestingPile("coordinates", fmt::format("pile, {:g} radii from the origin", radii),
                                {.friction = 0.3, .origin = {0.5 * radii, -0.5 * radii}}));
    cases.back().quick = radii == 1e6;
  }
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    ExtremeCase c = RestingPile("tolerance", fmt::format("pile, nat {:g}", tolerance), {.friction = 0.3});
    c.criterion = "nat";
    c.tolerance = tolerance;
    c.quick = tolerance == 1e-12;
    cases.push_back(c);
  }
  return cases;
}

}  // namespace nscdd
