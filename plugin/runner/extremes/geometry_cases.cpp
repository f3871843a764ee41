// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "extremes/extreme_case.h"
#include "extremes/scenes.h"

namespace nscdd {
namespace {

ExtremeCase Make(const std::string& family, const std::string& name, std::function<void(reference::World*)> build) {
  ExtremeCase c{.family = family, .name = name, .build = std::move(build)};
  c.quick = true;
  return c;
}

/// Four disks, each sunk by 0.4 m into the one below.
void BuildSunkColumn(double gravity, reference::World* world) {
  world->gravity = {0.0, -gravity};
  AddFloor(world, 0);
  for (int k = 0; k < 4; ++k) AddGrain(world, k + 1, {0.0, 0.5 + 0.6 * k}, 0.5);
}

/// With feedback 0.05 every contact above the floor opens at 0.05 x 0.4 m / dt = 2 m/s.
ExtremeCase Recovery(const std::string& name, double gravity) {
  ExtremeCase c = Make("overlap", name, [gravity](reference::World* w) { BuildSunkColumn(gravity, w); });
  c.options = {{"normal_law", "feedback"}, {"feedback_beta", "0.05"}};
  c.truth = [](std::int64_t id) { return Twist{0.0, 2.0 * static_cast<double>(id - 1), 0.0}; };
  c.scale = 2.0;
  c.feeds_energy = true;
  return c;
}

/// A disk flies towards a wall without thickness, 2.5 m away or just before it.
ExtremeCase ThinWall(const std::string& name, double x, double speed, int steps) {
  ExtremeCase c = Make("tunnelling", name, [=](reference::World* world) {
    reference::Body wall = reference::MakeWall(0);
    wall.segments = {{{3.0, -5.0}, {3.0, 5.0}}};
    world->Add(wall);
    AddGrain(world, 1, {x, 0.0}, 0.5).velocity.vx = speed;
  });
  c.scale = speed;
  c.steps = steps;
  return c;
}

void AddFlights(std::vector<ExtremeCase>* cases) {
  const auto apart = [](Vec2 gravity, double speed) {
    return [=](reference::World* world) {
      world->gravity = gravity;
      for (int k = 0; k < 9; ++k) AddGrain(world, k, {2.0 * (k % 3), 2.0 * (k / 3)}, 0.5).velocity.vx = speed;
    };
  };
  ExtremeCase fall = Make("flight", "free fall, 10 steps", apart({0.0, -kGravity}, 0.0));
  fall.steps = 10;
  fall.scale = kGravity * 0.1;
  fall.truth = [](std::int64_t) { return Twist{0.0, -kGravity * 0.1, 0.0}; };
  cases->push_back(fall);
  cases->push_back(Make("flight", "no gravity, at rest", apart({}, 0.0)));
  ExtremeCase drift = Make("flight", "no gravity, in uniform motion", apart({}, 1.0));
  drift.steps = 10;
  drift.scale = 1.0;
  drift.truth = [](std::int64_t) { return Twist{1.0, 0.0, 0.0}; };
  cases->push_back(drift);
  ExtremeCase touching = Make("flight", "no gravity, touching pile at rest", [](reference::World* world) {
    BuildPile({.friction = 0.3}, world);
    world->gravity = {};
  });
  cases->push_back(touching);
}

void AddFew(std::vector<ExtremeCase>* cases) {
  cases->push_back(Make("few bodies", "one disk", [](reference::World* w) { BuildStack({{}}, 0.3, {}, w); }));
  cases->push_back(Make("few bodies", "a floor, no disk", [](reference::World* w) { BuildStack({}, 0.3, {}, w); }));
  cases->push_back(Make("few bodies", "nothing", [](reference::World*) {}));
  cases->push_back(Make("few bodies", "all bodies fixed, overlapping", [](reference::World* w) {
    for (int k = 0; k < 4; ++k) AddGrain(w, k, {0.3 * k, 0.0}, 0.5).kind = BodyKind::kPrescribed;
  }));
}

}  // namespace

std::vector<ExtremeCase> GeometryCases() {
  std::vector<ExtremeCase> cases;
  cases.push_back(Make("overlap", "column sunk by 0.8 radii", [](reference::World* w) { BuildSunkColumn(kGravity, w); }));
  cases.push_back(Recovery("the same, with recovery", kGravity));
  cases.push_back(Recovery("the same, with recovery, no gravity", 0.0));
  cases.push_back(Make("overlap", "coincident centres", [](reference::World* world) {
    BuildStack({{}}, 0.0, {}, world);
    AddGrain(world, 2, {0.0, 0.5}, 0.5);
    AddGrain(world, 3, {0.0, 0.5}, 0.5);
  }));
  cases.push_back(ThinWall("thin wall, drift 0.08 radii a step", 2.46, 4.0, 3));
  cases.push_back(ThinWall("thin wall, drift 20 radii a step", 0.0, 1e3, 1));
  cases.push_back(ThinWall("the same, alert distance 40 radii", 0.0, 1e3, 1));
  cases.back().options = {{"alert_distance", "20"}};
  AddFlights(&cases);
  AddFew(&cases);
  return cases;
}

}  // namespace nscdd
