// SPDX-License-Identifier: Apache-2.0
#include "dense_packing.h"

#include <cmath>
#include <random>

#include "nlgs/sweep.h"
#include "nscdd/reference/reference_adapter.h"
#include "subdomain.h"

namespace nscdd::benchmark {
namespace {

constexpr double kGravity = 9.81, kTilt = 0.3, kTimeStep = 0.01;
constexpr double kSpacing = 1.99, kRadiusSpread = 0.01, kJitter = 0.003;  // radii 1 +- spread [m]
constexpr int kSweeps = 400;

reference::World MakeWorld(int disks, double friction) {
  std::mt19937 random(11);
  const auto uniform = [&](double half) { return half * (random() / 2147483648.0 - 1.0); };
  const int columns = std::max(1, static_cast<int>(std::sqrt(disks)));
  const double width = kSpacing * (columns + 0.5), row_height = kSpacing * std::sqrt(0.75);
  reference::World world;
  world.gravity = {kGravity * std::sin(kTilt), -kGravity * std::cos(kTilt)};
  reference::Body box = reference::MakeWall(0);
  box.half_planes = {{{0.0, 1.0}, 0.0}, {{1.0, 0.0}, 0.0}, {{-1.0, 0.0}, -width}};
  box.friction = friction;
  world.Add(box);
  for (int k = 0; k < disks; ++k) {
    const int row = k / columns, column = k % columns;
    const Vec2 centre{kSpacing * (column + (row % 2 ? 1.0 : 0.5)) + uniform(kJitter),
                      0.99 + row_height * row + uniform(kJitter)};
    reference::Body disk = reference::MakeDisk(k + 1, centre, 1.0 + uniform(kRadiusSpread), 1.0);
    disk.friction = friction;
    world.Add(disk);
  }
  return world;
}

}  // namespace

DensePacking MakeDensePacking(int disks, double friction) {
  reference::World world = MakeWorld(disks, friction);
  reference::ReferenceAdapter adapter(&world);
  SteppingOptions stepping;
  stepping.alert_distance = 0.1;
  DensePacking packing;
  packing.problem = BuildSubdomain(ReadStepProblem(&adapter, stepping, kTimeStep));
  const SubdomainProblem& p = packing.problem;
  const std::size_t unknowns = Unknowns(p.model);
  packing.state = {p.free_velocity, std::vector<double>(unknowns * p.contact_count(), 0.0)};
  for (int k = 0; k < kSweeps; ++k) Sweep(p, &packing.state);
  for (std::size_t c = 0; c < p.contact_count(); ++c) packing.active += packing.state.impulse[unknowns * c] > 0.0;
  packing.active /= static_cast<double>(p.contact_count());
  return packing;
}

}  // namespace nscdd::benchmark
