// SPDX-License-Identifier: Apache-2.0
// What holds whatever the scene: mirrored, turned, shuffled and scaled scenes give the same velocities.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "host.h"
#include "packing.h"
#include "rows.h"

namespace nscdd {
namespace {

using test::Host;
using test::Packing;

constexpr double kG = 9.81, kDt = 0.01;

using Velocities = std::map<std::int64_t, Twist>;

template <class Options>
AlgorithmOptions Tight(int nx = 1, int ny = 1) {
  Options o;
  o.stopping.tolerance = 1e-12;
  o.stopping.max_iterations = 20000;
  if constexpr (requires { o.partition; }) o.partition = {nx, ny, 1};
  return o;
}

struct Named {
  const char* name;
  AlgorithmOptions options;
  double nat;       ///< it must come so far
  double rounding;  ///< [m/s, rad/s] in which velocities may differ; g dt is 0.1 m/s
};

/// Newton's factorisations end at 1e-12 with disks and at 1e-10 to 1e-9 with clusters.
std::vector<Named> Solvers() {
  return {{"nscd", Tight<NscdOptions>(), 1e-12, 1e-10},
          {"nscdd", Tight<NscddOptions>(2, 2), 1e-12, 1e-10},
          {"fea", Tight<FeaOptions>(2, 2), 1e-12, 1e-10},
          {"newton", Tight<NewtonOptions>(), 1e-8, 1e-8}};
}

/// One step of a dense packing, changed by `edit` before.
Velocities OneStep(const Packing& packing, const Named& solver,
                   const std::function<void(reference::Body*, Vec2* gravity)>& edit, double dt = kDt) {
  Host host({}, solver.options);
  host.world.gravity = {kG * std::sin(packing.tilt), -kG * std::cos(packing.tilt)};
  const Vec2 gravity = host.world.gravity;
  for (reference::Body body : test::MakeBodies(packing)) {
    host.world.gravity = gravity;
    edit(&body, &host.world.gravity);
    host.world.Add(body);
  }
  const StepReport& report = host.Step(dt);
  EXPECT_LE(report.solve.residuals.nat, solver.nat) << solver.name << ": " << report.solve.reason;
  Velocities velocities;
  for (const test::BodyRow& body : test::Rows(host.stepper().bodies())) velocities[body.id] = body.velocity;
  return velocities;
}

double Largest(
    const Velocities& one, const Velocities& other, const std::function<Twist(Twist)>& map = [](Twist v) { return v; }) {
  double largest = one.size() == other.size() ? 0.0 : INFINITY;
  for (const auto& [id, v] : one) {
    const Twist expected = map(v), w = other.at(id);
    largest = std::max({largest, std::abs(w.vx - expected.vx), std::abs(w.vy - expected.vy), std::abs(w.spin - expected.spin)});
  }
  return largest;
}

void Nothing(reference::Body*, Vec2*) {}

void Mirror(reference::Body* body, Vec2* gravity) {
  const auto mirror = [](Vec2 a) { return Vec2{-a.x, a.y}; };
  *gravity = mirror(*gravity);
  body->pose = {-body->pose.x, body->pose.y, -body->pose.angle};
  body->velocity = {-body->velocity.vx, body->velocity.vy, -body->velocity.spin};
  for (reference::Disk& d : body->disks) d.centre = mirror(d.centre);
  for (reference::Segment& s : body->segments) s = {mirror(s.a), mirror(s.b)};
}

constexpr double kTurn = 0.7;

Twist TurnTwist(Twist v) {
  const Vec2 turned = Rotate(kTurn, Linear(v));
  return {turned.x, turned.y, v.spin};
}

void Turn(reference::Body* body, Vec2* gravity) {
  *gravity = Rotate(kTurn, *gravity);
  const Vec2 centre = Rotate(kTurn, Centre(body->pose));
  body->pose = {centre.x, centre.y, body->pose.angle + kTurn};
  body->velocity = TurnTwist(body->velocity);
}

const Packing kDense{.columns = 6, .rows = 5};
const Packing kSmooth{.columns = 6, .rows = 5, .friction = 0.0};
const Packing kClusters{.columns = 6, .rows = 5, .clusters = true};

TEST(Symmetry, MirroredScenesMoveMirrored) {
  for (const Named& solver : Solvers()) {
    for (const Packing& packing : {kDense, kSmooth, kClusters}) {
      const Velocities plain = OneStep(packing, solver, Nothing), mirrored = OneStep(packing, solver, Mirror);
      EXPECT_LT(Largest(plain, mirrored, [](Twist v) { return Twist{-v.vx, v.vy, -v.spin}; }), solver.rounding) << solver.name;
    }
  }
}

TEST(Symmetry, TurnedScenesMoveTurned) {
  for (const Named& solver : Solvers()) {
    for (const Packing& packing : {kDense, kSmooth, kClusters}) {
      const Velocities plain = OneStep(packing, solver, Nothing), turned = OneStep(packing, solver, Turn);
      EXPECT_LT(Largest(plain, turned, TurnTwist), solver.rounding) << solver.name;
    }
  }
}

// Other ids: another order of the sweeps.
TEST(Symmetry, ShuffledScenesMoveAlike) {
  const auto shuffled = [](std::int64_t id) { return (17 * id + 5) % 101; };
  for (const Named& solver : Solvers()) {
    for (const Packing& packing : {kDense, kSmooth, kClusters}) {
      const Velocities plain = OneStep(packing, solver, Nothing);
      const Velocities other = OneStep(packing, solver, [&](reference::Body* body, Vec2*) { body->id = shuffled(body->id); });
      Velocities expected;
      for (const auto& [id, v] : plain) expected[shuffled(id)] = v;
      ASSERT_EQ(expected.size(), plain.size());
      EXPECT_LT(Largest(expected, other), solver.rounding) << solver.name;
    }
  }
}

TEST(Symmetry, PowersOfTwoScaleEveryBit) {
  for (const Named& solver : Solvers()) {
    const Velocities plain = OneStep(kClusters, solver, Nothing);
    for (const double length : {0x1p-20, 0x1p10}) {
      const double time = std::sqrt(length);
      const auto scale = [&](reference::Body* body, Vec2*) {
        body->mass *= 0x1p30;
        body->inertia *= 0x1p30 * length * length;
        body->pose = {length * body->pose.x, length * body->pose.y, body->pose.angle};
        const double speed = length / time;
        body->velocity = {speed * body->velocity.vx, speed * body->velocity.vy, body->velocity.spin / time};
        for (reference::Disk& d : body->disks) d = {length * d.centre, length * d.radius};
        for (reference::Segment& s : body->segments) s = {length * s.a, length * s.b};
      };
      const Velocities scaled = OneStep(kClusters, solver, scale, kDt * time);
      EXPECT_EQ(Largest(plain, scaled,
                        [&](Twist v) {
                          return Twist{v.vx * length / time, v.vy * length / time, v.spin / time};
                        }),
                0.0)
          << solver.name << ", length " << length;
    }
  }
}

}  // namespace
}  // namespace nscdd
