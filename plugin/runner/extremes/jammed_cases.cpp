// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "extremes/extreme_case.h"
#include "extremes/scenes.h"

namespace nscdd {
namespace {

/// Touching disks between two fixed ones along the funicular curve of their weights (slopes of the links in equal steps): at
/// rest, by normal forces alone.
void BuildArch(int disks, double friction, reference::World* world) {
  world->gravity = {0.0, -kGravity};
  Vec2 centre{};
  for (int k = 0; k <= disks + 1; ++k) {
    reference::Body& grain = AddGrain(world, k, centre, 0.5, friction);
    if (k == 0 || k == disks + 1) grain.kind = BodyKind::kPrescribed;
    const double slope = std::atan(0.15 * (0.5 * disks - k));
    centre = centre + Vec2{std::cos(slope), std::sin(slope)};
  }
}

/// A disk in a groove of two half-planes, `angle` from the horizontal: with friction, a whole set of impulses holds it.
void BuildWedge(double angle, double friction, reference::World* world) {
  world->gravity = {0.0, -kGravity};
  reference::Body groove = reference::MakeWall(0);
  groove.half_planes = {{{std::sin(angle), std::cos(angle)}, 0.0}, {{-std::sin(angle), std::cos(angle)}, 0.0}};
  groove.friction = friction;
  world->Add(groove);
  AddGrain(world, 1, {0.0, 0.5 / std::cos(angle)}, 0.5, friction);
}

/// Disks in a row between two half-planes, the right one coming with `speed`.
void BuildSqueeze(int disks, double speed, double friction, reference::World* world) {
  for (const double side : {1.0, -1.0}) {
    reference::Body wall = reference::MakeWall(side > 0.0 ? 0 : 1);
    wall.half_planes = {{{side, 0.0}, side > 0.0 ? 0.0 : -static_cast<double>(disks)}};
    wall.friction = friction;
    if (side < 0.0) wall.velocity.vx = -speed;
    world->Add(wall);
  }
  for (int k = 0; k < disks; ++k) AddGrain(world, 2 + k, {0.5 + k, 0.0}, 0.5, friction);
}

ExtremeCase Make(const std::string& name, std::function<void(reference::World*)> build, bool quick = false) {
  ExtremeCase c{.family = "jammed", .name = name, .build = std::move(build)};
  c.quick = quick;
  return c;
}

ExtremeCase Moving(const std::string& name, const Pile& pile, double scale) {
  ExtremeCase c{.family = "moving", .name = name, .build = [pile](reference::World* world) { BuildPile(pile, world); }};
  c.truth = nullptr;
  c.scale = scale;
  return c;
}

}  // namespace

std::vector<ExtremeCase> JammedCases() {
  std::vector<ExtremeCase> cases;
  for (const double mu : {0.0, 0.5}) {
    for (const int disks : {3, 9}) {
      cases.push_back(Make(
          fmt::format("arch of {} disks, mu {:g}", disks, mu), [=](reference::World* w) { BuildArch(disks, mu, w); },
          disks == 9));
    }
  }
  for (const double angle : {45.0, 85.0, 89.9}) {
    for (const double mu : {0.0, 1.0}) {
      const double radians = angle * std::numbers::pi / 180.0;
      cases.push_back(Make(
          fmt::format("wedge of {:g} degrees, mu {:g}", angle, mu), [=](reference::World* w) { BuildWedge(radians, mu, w); },
          angle == 85.0));
      cases.back().extent = 0.5 / std::cos(radians);
      cases.back().amplification = 1.0 / std::cos(radians);
    }
  }
  for (const double mu : {0.0, 0.5}) {
    cases.push_back(Make(fmt::format("pile pressed by 1e-3, mu {:g}", mu),
                         [mu](reference::World* w) { BuildPile({.friction = mu, .spacing = 0.999}, w); }));
  }
  for (const double speed : {1e-3, 1.0}) {
    for (const double mu : {0.0, 0.5}) {
      cases.push_back(Make(
          fmt::format("no room, closing at {:g} m/s, mu {:g}", speed, mu),
          [=](reference::World* w) { BuildSqueeze(3, speed, mu, w); }, speed == 1.0));
      cases.back().family = "no solution";
      cases.back().scale = speed;
      cases.back().has_no_solution = true;
      cases.back().criterion = "nat";
      cases.back().tolerance = 1e-4;
    }
  }
  // Frictionless: the velocity is unique, and a tight solution is the truth.
  cases.push_back(Moving("collapse, mu 0", {.right_wall = false}, kGravity * 0.01));
  cases.push_back(Moving("random impact, mu 0", {.largest_velocity = 1.0}, 1.0));
  cases.back().quick = true;
  return cases;
}

}  // namespace nscdd
