// SPDX-License-Identifier: Apache-2.0
#include "extremes/scenes.h"

#include <cmath>
#include <random>

namespace nscdd {

void AddFloor(reference::World* world, std::int64_t id, double height, double friction) {
  reference::Body floor = reference::MakeWall(id, {0.0, height, 0.0});
  floor.half_planes.push_back({});
  floor.friction = friction;
  world->Add(floor);
}

reference::Body& AddGrain(reference::World* world, std::int64_t id, Vec2 centre, double radius, double friction,
                          double density) {
  reference::Body disk = reference::MakeDisk(id, centre, radius, density);
  disk.friction = friction;
  return world->Add(disk);
}

void BuildStack(const std::vector<Grain>& grains, double friction, Vec2 origin, reference::World* world) {
  world->gravity = {0.0, -kGravity};
  AddFloor(world, 0, origin.y, friction);
  double top = 0.0;
  std::int64_t id = 1;
  for (const Grain& grain : grains) {
    AddGrain(world, id++, origin + Vec2{0.0, top + grain.radius}, grain.radius, friction, grain.density);
    top += 2.0 * grain.radius;
  }
}

void BuildPile(const Pile& p, reference::World* world) {
  world->gravity = {0.0, -kGravity};
  const double r = p.radius, pitch = 2.0 * r * p.spacing, rise = std::sqrt(3.0) * r * p.spacing;
  const double width = (p.columns - 1) * pitch + 2.0 * r, height = p.rows * 2.0 * r + 4.0 * r;
  reference::Body box = reference::MakeWall(0, {p.origin.x, p.origin.y, 0.0});
  box.segments = {{{0.0, height}, {0.0, 0.0}}, {{0.0, 0.0}, {width + (p.right_wall ? 0.0 : 20.0 * r), 0.0}}};
  if (p.right_wall) box.segments.push_back({{width, 0.0}, {width, height}});
  box.friction = p.friction;
  world->Add(box);
  std::mt19937 random(3);
  const auto draw = [&] { return p.largest_velocity * (2.0 * (random() / 4294967296.0) - 1.0); };
  std::int64_t id = 1;
  for (int row = 0; row < p.rows; ++row) {
    const bool odd = row % 2 == 1;
    for (int k = 0; k < p.columns - odd; ++k) {
      const double friction = id % 2 == 0 && p.other_friction >= 0.0 ? p.other_friction : p.friction;
      const Vec2 centre = p.origin + Vec2{r + pitch * (k + (odd ? 0.5 : 0.0)), r + row * rise};
      reference::Body& grain = AddGrain(world, id++, centre, r, friction);
      if (p.largest_velocity > 0.0) grain.velocity = {draw(), draw(), 0.0};
    }
  }
}

}  // namespace nscdd
