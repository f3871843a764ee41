// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "extremes/extreme_case.h"
#include "extremes/scenes.h"

namespace nscdd {
namespace {

/// A disk on an incline after one step from rest: it slides if 3 mu < tan(angle), else it rolls.
ExtremeCase Incline(double friction) {
  constexpr double kAngle = 0.4, kRadius = 0.5;
  ExtremeCase c{.family = "friction", .name = fmt::format("disk on an incline, mu {:g}", friction), .build = {}};
  c.build = [friction](reference::World* world) {
    world->gravity = {kGravity * std::sin(kAngle), -kGravity * std::cos(kAngle)};
    AddFloor(world, 0, 0.0, friction);
    AddGrain(world, 1, {0.0, kRadius}, kRadius, friction);
  };
  const bool slides = 3.0 * friction < std::tan(kAngle);
  const double rolling = 2.0 / 3.0 * kGravity * std::sin(kAngle);
  const double a = slides ? kGravity * (std::sin(kAngle) - friction * std::cos(kAngle)) : rolling;
  const double spin = (slides ? -2.0 * friction * kGravity * std::cos(kAngle) : -rolling) / kRadius;
  c.truth = [a, spin, dt = c.dt](std::int64_t) { return Twist{a * dt, 0.0, spin * dt}; };
  c.quick = friction == 1.0;
  return c;
}

ExtremeCase RestingPile(const std::string& name, double friction, double other, bool quick) {
  ExtremeCase c{.family = "friction", .name = name, .build = {}};
  c.build = [=](reference::World* world) { BuildPile({.friction = friction, .other_friction = other}, world); };
  c.quick = quick;
  return c;
}

/// Two disks in one rigid body, lying on the floor: the arms couple the normal with the tangent.
ExtremeCase Dumbbell(double friction) {
  ExtremeCase c{.family = "friction", .name = fmt::format("dumb-bell, mu {:g}", friction), .build = {}};
  c.build = [friction](reference::World* world) {
    world->gravity = {0.0, -kGravity};
    AddFloor(world, 0, 0.0, friction);
    const std::array<reference::Disk, 2> disks{{{{-0.5, 0.5}, 0.5}, {{0.5, 0.5}, 0.5}}};
    reference::Body body = reference::MakeCluster(1, disks, 1000.0);
    body.friction = friction;
    world->Add(body);
  };
  return c;
}

ExtremeCase Bounce(double restitution) {
  ExtremeCase c{.family = "restitution", .name = fmt::format("disk on the floor, e {:g}", restitution), .build = {}};
  c.build = [restitution](reference::World* world) {
    AddFloor(world, 0);
    reference::Body& disk = AddGrain(world, 1, {0.0, 0.5 + 0.5 * 0.0078125}, 0.5);
    disk.velocity.vy = -1.0;
    disk.restitution = restitution;
  };
  c.truth = [restitution](std::int64_t) { return Twist{0.0, restitution, 0.0}; };
  c.scale = 1.0;
  c.dt = 0.0078125;
  c.quick = restitution == 0.5;
  return c;
}

/// Five disks in a row, the first one arrives with 1 m/s; `distance` apart, in units of what it covers in a step.
void BuildCradle(double restitution, int distance, double dt, reference::World* world) {
  for (int k = 0; k < 5; ++k) {
    const double x = k + distance * dt * k - (k == 0 ? 0.5 * dt : 0.0);
    reference::Body& disk = AddGrain(world, k, {x, 0.0}, 0.5);
    disk.restitution = restitution;
    if (k == 0) disk.velocity.vx = 1.0;
  }
}

/// Newton's law at all contacts at once: the four others leave together, u - V = e, V + 4 u = 1.
ExtremeCase TouchingCradle(double restitution) {
  ExtremeCase c{.family = "restitution", .name = fmt::format("Newton's cradle, touching, e {:g}", restitution), .build = {}};
  c.dt = 0.0078125;
  c.build = [restitution, dt = c.dt](reference::World* world) { BuildCradle(restitution, 0, dt, world); };
  c.truth = [e = restitution](std::int64_t id) { return Twist{id == 0 ? (1.0 - 4.0 * e) / 5.0 : (1.0 + e) / 5.0, 0.0, 0.0}; };
  c.scale = 1.0;
  c.subdomains = "5x1";
  c.quick = restitution == 1.0;
  return c;
}

/// With room between the disks the impacts come one by one: the last one leaves with 1 m/s, the others stay.
ExtremeCase SpacedCradle() {
  ExtremeCase c{.family = "restitution", .name = "Newton's cradle, apart, e 1", .build = {}};
  c.dt = 0.0078125;
  c.build = [dt = c.dt](reference::World* world) { BuildCradle(1.0, 4, dt, world); };
  c.truth = [](std::int64_t id) { return Twist{id == 4 ? 1.0 : 0.0, 0.0, 0.0}; };
  c.scale = 1.0;
  c.steps = 20;
  c.quick = true;
  c.subdomains = "5x1";
  return c;
}

}  // namespace

std::vector<ExtremeCase> LawCases() {
  std::vector<ExtremeCase> cases;
  for (const double mu : {0.0, 0.1, 0.2, 1.0, 10.0, 1e3}) cases.push_back(Incline(mu));
  for (const double mu : {0.0, 0.1, 0.3, 1.0, 10.0, 1e3}) {
    cases.push_back(RestingPile(fmt::format("pile, mu {:g}", mu), mu, -1.0, mu == 0.3 || mu == 1e3));
  }
  cases.push_back(RestingPile("pile, mu 0.3, every other grain 0", 0.3, 0.0, false));
  cases.push_back(RestingPile("pile, mu 0.3, every other grain 1000", 0.3, 1e3, true));
  for (const double mu : {0.3, 10.0, 1e3}) cases.push_back(Dumbbell(mu));
  for (const double e : {0.0, 0.5, 1.0}) cases.push_back(Bounce(e));
  for (const double e : {0.0, 0.5, 1.0}) cases.push_back(TouchingCradle(e));
  cases.push_back(SpacedCradle());
  return cases;
}

}  // namespace nscdd
