// SPDX-License-Identifier: Apache-2.0
#include "packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "nscdd/reference/reference_adapter.h"
#include "rows.h"

namespace nscdd::test {
namespace {

constexpr double kGravity = 9.81;

reference::Body MakeFloor(const Packing& p, double width) {
  const double height = p.turning_wall ? -0.6 : p.periodic ? -0.7 : -1.0;  // the floor's top is at 0
  reference::Body floor = reference::MakeWall(0, {0.5 * width, height, 0.0});
  if (p.pegs) {
    for (int i = 0; i < p.rows * p.columns; ++i) {
      floor.disks.push_back({{2.0 * (i % p.columns) + 1.0 - 0.5 * width, 3.0 * (i / p.columns) + 1.0}, 0.5});
    }
    return floor;
  }
  if (p.turning_wall) {
    floor.velocity.spin = 0.2;
    for (int i = 0; i < 2 * p.columns; ++i) floor.disks.push_back({{i - 0.5 * width, 0.0}, 0.6});
    return floor;
  }
  if (p.periodic) {
    for (int i = 0; i < 2 * p.columns; ++i) floor.disks.push_back({{i + 0.5 - 0.5 * width, 0.2}, 0.5});
    return floor;
  }
  const double half = 0.5 * width, top = 4.0 * p.rows;
  floor.segments = {{{-half, top}, {-half, 1.0}}, {{-half, 1.0}, {half, 1.0}}, {{half, 1.0}, {half, top}}};
  return floor;
}

std::vector<reference::Body> MakePegs(const Packing& p) {
  std::vector<reference::Body> bodies{MakeFloor(p, 2.0 * p.columns)};
  bodies.front().friction = p.friction;
  for (int i = 0; i < p.rows * p.columns; ++i) {
    const Vec2 centre{2.0 * (i % p.columns) + 1.1, 3.0 * (i / p.columns) + 0.995};
    bodies.push_back(reference::MakeDisk(1 + i, centre, 0.5, 1.0));
    bodies.back().friction = p.friction;
  }
  return bodies;
}

}  // namespace

std::vector<reference::Body> MakeBodies(const Packing& p) {
  if (p.pegs) return MakePegs(p);
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  const double width = 2.0 * p.columns;
  std::vector<reference::Body> bodies{MakeFloor(p, width)};
  bodies.front().friction = p.friction;
  for (int row = 0; row < p.rows; ++row) {
    for (int column = 0; column < p.columns; ++column) {
      const double x = 2.0 * column + (row % 2 ? 1.45 : 0.75), y = 0.95 + 1.74 * row;
      const auto id = static_cast<std::int64_t>(1 + bodies.size());
      const Vec2 centre{std::clamp(x + uniform(-0.03, 0.03), 0.5, width - 0.8), y + uniform(-0.03, 0.03)};
      const double radius = uniform(0.94, 1.02);
      const bool dumb_bell = p.clusters && bodies.size() % 5 == 0;
      const reference::Disk pair[2] = {{centre - Vec2{0.4, 0.1}, 0.6}, {centre + Vec2{0.4, 0.1}, 0.5}};
      reference::Body body = dumb_bell ? reference::MakeCluster(id, pair, 1.0) : reference::MakeDisk(id, centre, radius, 1.0);
      body.friction = p.half_rough && 2 * row >= p.rows ? 0.0 : p.friction;
      body.restitution = p.restitution;
      body.velocity = {uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(-0.2, 0.2)};
      bodies.push_back(body);
    }
  }
  return bodies;
}

Outcome Run(const Packing& packing, const SteppingOptions& stepping, const AlgorithmOptions& algorithm, int steps,
            Communicator* communicator) {
  reference::World world;
  world.gravity = {kGravity * std::sin(packing.tilt), -kGravity * std::cos(packing.tilt)};
  if (packing.periodic) world.period = 2.0 * packing.columns;
  const std::vector<reference::Body> all = MakeBodies(packing);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (static_cast<int>(k * communicator->size() / all.size()) == communicator->rank()) world.Add(all[k]);
  }
  reference::ReferenceAdapter adapter(&world);
  TimeStepper stepper(stepping, algorithm, &adapter, communicator);
  Outcome outcome;
  for (int k = 0; k < steps; ++k) outcome.reports.push_back(stepper.Step(0.01));

  std::vector<double> mine;
  for (const test::BodyRow& b : test::Rows(stepper.bodies())) {
    mine.insert(mine.end(), {static_cast<double>(b.id), b.pose.x, b.pose.y, b.pose.angle, b.velocity.vx, b.velocity.vy,
                             b.velocity.spin, static_cast<double>(b.multiplicity), static_cast<double>(b.subdomain)});
  }
  const std::vector<double> gathered = communicator->AllGather(mine);
  for (std::size_t i = 0; i < gathered.size(); i += 9) {
    const double* r = &gathered[i];
    outcome.bodies.push_back({static_cast<std::int64_t>(r[0]),
                              BodyKind::kFree,
                              {r[1], r[2], r[3]},
                              {r[4], r[5], r[6]},
                              static_cast<int>(r[7]),
                              static_cast<int>(r[8])});
  }
  std::sort(outcome.bodies.begin(), outcome.bodies.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return outcome;
}

std::string Difference(const Outcome& one, const Outcome& other) {
  if (one.bodies.size() != other.bodies.size()) return fmt::format("{} and {} bodies", one.bodies.size(), other.bodies.size());
  for (std::size_t k = 0; k < one.reports.size(); ++k) {
    std::string difference;
    const auto compare = [&](const Figure& figure, const auto& a, const auto& b) {
      if (figure.kind == FigureKind::kResult && a != b) difference = fmt::format("step {}: {} differs", k + 1, figure.name);
    };
    ForEachFigure(compare, one.reports[k], other.reports[k]);
    if (!difference.empty()) return difference;
  }
  for (std::size_t i = 0; i < one.bodies.size(); ++i) {
    const BodyRow &a = one.bodies[i], &b = other.bodies[i];
    if (a.id != b.id || std::memcmp(&a.pose, &b.pose, sizeof(Pose)) != 0 ||
        std::memcmp(&a.velocity, &b.velocity, sizeof(Twist)) != 0 || a.multiplicity != b.multiplicity ||
        a.subdomain != b.subdomain) {
      return fmt::format("body {}: x {:.17g} and {:.17g}, vx {:.17g} and {:.17g}, multiplicity {} and {}", a.id, a.pose.x,
                         b.pose.x, a.velocity.vx, b.velocity.vx, a.multiplicity, b.multiplicity);
    }
  }
  return {};
}

}  // namespace nscdd::test
