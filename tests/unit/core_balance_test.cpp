// SPDX-License-Identifier: Apache-2.0
// Momentum and energy of every step come from somewhere: loads, walls, and sources that are counted.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <vector>

#include "host.h"
#include "packing.h"
#include "rows.h"

namespace nscdd {
namespace {

using test::Host;
using test::Packing;

constexpr double kG = 9.81, kDt = 0.01;

struct Named {
  const char* name;
  AlgorithmOptions options;
};

/// Bodies before a step, for its balance.
std::map<std::int64_t, reference::Body> Snapshot(const Host& host) {
  std::map<std::int64_t, reference::Body> bodies;
  for (const reference::Body& body : host.world.bodies()) bodies[body.id] = body;
  return bodies;
}

/// Velocity of a body's point at the contact, half-way through the step.
Vec2 PointVelocity(const reference::Body& before, const Twist& v, Vec2 point) {
  const Vec2 arm = point - (Centre(before.pose) + 0.5 * kDt * Linear(before.velocity));
  return Linear(v) + v.spin * Vec2{-arm.y, arm.x};
}

struct Balance {
  double momentum = 0.0;  ///< | sum m (V - V_f) - impulses of walls | [N s]
  double impulses = 0.0;  ///< sum of all impulses and loads [N s]
  double energy = 0.0;    ///< gained by the free bodies, gravity's potential included [J]
  double work = 0.0;      ///< of all impulses on them, by mean velocities [J]
  double walls = 0.0;     ///< part of it that moving walls do [J]
  double sources = 0.0;   ///< sum of max(0, r . (v + v') / 2) over the contacts: what the scheme and the residual feed [J]
};

void AddContact(const test::ContactRow& c, const Host& host, const std::map<std::int64_t, reference::Body>& before,
                Vec2* momentum, Balance* balance) {
  const Vec2 r = c.impulse.x * c.normal + c.impulse.y * Vec2{c.normal.y, -c.normal.x};
  double relative = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    const std::int64_t id = sign < 0.0 ? c.key.body_a : c.key.body_b;
    const reference::Body& body = before.at(id);
    const Vec2 mean =
        0.5 * (PointVelocity(body, body.velocity, c.point) + PointVelocity(body, host.world.Find(id)->velocity, c.point));
    const double power = sign * Dot(r, mean);
    relative += power;
    if (body.kind == BodyKind::kFree) {
      balance->work += power;
    } else {
      *momentum = *momentum + sign * r;  // on the wall: the free bodies get the opposite
      balance->walls -= power;
    }
  }
  balance->sources += std::max(0.0, relative);
  balance->impulses += Norm(r);
}

Balance StepWithBalance(Host* host) {
  const auto before = Snapshot(*host);
  host->Step(kDt);
  Balance balance;
  Vec2 momentum{};
  const Vec2 g = host->world.gravity;
  for (const auto& [id, body] : before) {
    if (body.kind != BodyKind::kFree) continue;
    const reference::Body& after = *host->world.Find(id);
    const Twist &v = body.velocity, &w = after.velocity;
    momentum = momentum + body.mass * (Linear(w) - Linear(v) - kDt * g);
    balance.impulses += body.mass * kDt * kG;
    balance.energy += 0.5 * body.mass * (Dot(Linear(w), Linear(w)) - Dot(Linear(v), Linear(v))) +
                      0.5 * body.inertia * (w.spin * w.spin - v.spin * v.spin) -
                      body.mass * Dot(g, Centre(after.pose) - Centre(body.pose));
  }
  for (const test::ContactRow& c : test::Rows(host->stepper().contacts())) AddContact(c, *host, before, &momentum, &balance);
  balance.momentum = Norm(momentum);
  return balance;
}

void Fill(const Packing& packing, Host* host) {
  host->world.gravity = {kG * std::sin(packing.tilt), -kG * std::cos(packing.tilt)};
  for (const reference::Body& body : test::MakeBodies(packing)) host->world.Add(body);
}

TEST(Balance, EveryStepOfEverySolverKeepsMomentum) {
  const PartitionOptions grid{3, 2, 1};
  const StoppingOptions loose{.tolerance = 1e-3, .max_iterations = 200};
  FeaOptions fea;
  fea.stopping = loose;
  fea.partition = grid;
  ReaOptions rea;
  rea.stopping = loose;
  rea.partition = grid;
  IeaOptions iea;
  iea.stopping = loose;
  iea.partition = grid;
  const AccelerationOptions plain{.method = Acceleration::kNone};
  const Named solvers[] = {{"nscd", NscdOptions{loose, {}}},
                           {"nscd, plain", NscdOptions{loose, plain}},
                           {"nscdd", NscddOptions{loose, grid, 1, {}}},
                           {"nscdd, plain", NscddOptions{loose, grid, 1, plain}},
                           {"fea", fea},
                           {"rea", rea},
                           {"iea", iea},
                           {"newton", NewtonOptions{}}};
  for (const Named& solver : solvers) {
    for (const Packing& packing : {Packing{}, Packing{.clusters = true}, Packing{.restitution = 0.5, .turning_wall = true}}) {
      Host host({}, solver.options);
      Fill(packing, &host);
      for (int k = 0; k < 5; ++k) {
        const Balance balance = StepWithBalance(&host);
        ASSERT_GT(balance.impulses, 0.0);
        EXPECT_LT(balance.momentum, 1e-13 * balance.impulses) << solver.name << ", step " << k;
      }
    }
  }
}

struct LongRun {
  int steps = 0;
  double largest_defect = 0.0;  ///< | energy - work | of a step [J]
  double largest_rise = 0.0;    ///< of the energy in a step, the walls' work and the counted sources taken away
  double first = 0.0;           ///< energy gained since the beginning, after half the steps [J]
  double last = 0.0;            ///< at the end
  double highest = 0.0;         ///< ever, walls' work taken away
  double walls = 0.0, sources = 0.0;
};

/// 2000, or what the environment says: `tests/long/long_runs.py --energy` says 100000.
int LongRunSteps() {
  const char* text = std::getenv("NSCDD_BALANCE_STEPS");
  return text ? std::max(2, std::atoi(text)) : 2000;
}

LongRun RunLong(Host* host) {
  LongRun run{.steps = LongRunSteps()};
  for (int k = 0; k < run.steps; ++k) {
    const Balance balance = StepWithBalance(host);
    run.largest_defect = std::max(run.largest_defect, std::abs(balance.energy - balance.work));
    run.largest_rise = std::max(run.largest_rise, balance.energy - balance.walls - balance.sources);
    run.last += balance.energy;
    run.walls += balance.walls;
    run.sources += balance.sources;
    run.highest = std::max(run.highest, run.last - run.walls);
    if (k == run.steps / 2) run.first = run.last;
  }
  return run;
}

/// m g r of a grain: 30 J.
constexpr double kGrain = std::numbers::pi * kG;

/// For gtest's report.
void Record(const LongRun& run) {
  testing::Test::RecordProperty("steps", run.steps);
  const std::pair<const char*, double> numbers[] = {{"largest_defect", run.largest_defect},
                                                    {"largest_rise", run.largest_rise},
                                                    {"energy_at_half", run.first},
                                                    {"energy_at_end", run.last},
                                                    {"highest_energy", run.highest},
                                                    {"work_of_walls", run.walls},
                                                    {"sources", run.sources}};
  for (const auto& [name, number] : numbers) testing::Test::RecordProperty(name, fmt::format("{:.3g}", number / kGrain));
}

TEST(Balance, ARestingPileGainsNoEnergyInALongRun) {
  Host host;
  Fill({.columns = 6, .rows = 5, .tilt = 0.0}, &host);
  const LongRun run = RunLong(&host);
  Record(run);
  EXPECT_LT(run.largest_defect, 1e-9 * kGrain);
  EXPECT_LT(run.largest_rise, 1e-9 * kGrain);
  EXPECT_EQ(run.walls, 0.0);
  EXPECT_LT(run.last, 0.0);
  EXPECT_LT(run.last, run.first + 1e-3 * kGrain);
  EXPECT_LT(run.highest, 1e-3 * kGrain);
  EXPECT_LT(run.sources, 0.06 * -run.last);
}

TEST(Balance, ADrumGetsItsEnergyFromTheWallInALongRun) {
  Host host;
  host.world.gravity = {0.0, -kG};
  reference::Body drum = reference::MakeWall(0);
  constexpr int kSides = 12;
  for (int k = 0; k < kSides; ++k) {
    const auto corner = [&](int i) { return 8.0 * Rotate(2.0 * std::numbers::pi * (i % kSides) / kSides, {1.0, 0.0}); };
    drum.segments.push_back({corner(k), corner(k + 1)});
  }
  drum.friction = 0.5;
  drum.velocity.spin = 0.5;
  host.world.Add(drum);
  for (int k = 0; k < 40; ++k) {
    host.AddDisk(k + 1, {-4.0 + 1.15 * (k % 8), -3.0 + 1.15 * (k / 8)}, 0.45 + 0.01 * (k % 10), 0.5);
  }
  for (const reference::Body& body : host.world.bodies()) {
    if (body.kind != BodyKind::kFree) continue;
    host.body(body.id).mass /= 1000.0;
    host.body(body.id).inertia /= 1000.0;
  }
  const LongRun run = RunLong(&host);
  Record(run);
  EXPECT_LT(run.largest_defect, 1e-9 * kGrain);
  EXPECT_LT(run.largest_rise, 1e-9 * kGrain);
  EXPECT_GT(run.walls, kGrain);
  EXPECT_LT(run.sources, 0.05 * run.walls);
  EXPECT_LT(run.highest, run.sources + 1e-6 * kGrain);
}

}  // namespace
}  // namespace nscdd
