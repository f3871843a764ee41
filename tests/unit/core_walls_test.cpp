// SPDX-License-Identifier: Apache-2.0
// Prescribed motion: the velocity of a wall at the touching point drives the bodies; nothing changes the wall.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host.h"

namespace nscdd {
namespace {

using test::Exact;
using test::Host;

constexpr double kG = 9.81;
constexpr double kDt = 0.01;

reference::Body& AddSegment(Host* host, std::int64_t id, double half_length, double friction) {
  reference::Body wall = reference::MakeWall(id);
  wall.segments.push_back({{-half_length, 0.0}, {half_length, 0.0}});
  wall.friction = friction;
  return host->world.Add(wall);
}

// A belt of speed U: the disk slides with mu g until v = U / 3 and spin r = 2 U / 3, then it rolls.
TEST(MovingWall, ConveyorDragsADisk) {
  const double speed = 2.0, mu = 0.2;
  Host host({}, Exact());
  host.world.gravity = {0.0, -kG};
  AddSegment(&host, 0, 100.0, mu).velocity.vx = speed;
  const reference::Body& disk = host.AddDisk(1, {0.0, 0.5}, 0.5, mu);
  host.Step(20, kDt);
  EXPECT_NEAR(disk.velocity.vx, mu * kG * 0.2, 1e-12);
  EXPECT_NEAR(disk.velocity.spin, 2.0 * mu * kG * 0.2 / 0.5, 1e-12);
  host.Step(180, kDt);
  EXPECT_NEAR(disk.velocity.vx, speed / 3.0, 1e-10);
  EXPECT_NEAR(disk.velocity.spin * 0.5, 2.0 * speed / 3.0, 1e-10);
  EXPECT_NEAR(disk.pose.y, 0.5, 1e-12);
  EXPECT_NEAR(host.body(0).pose.x, speed * 2.0, 1e-12);
  EXPECT_EQ(host.body(0).velocity.vx, speed);
}

// A frictionless belt drags nothing, and its own friction coefficient does not matter.
TEST(MovingWall, FrictionlessConveyorDragsNothing) {
  Host host({}, Exact());
  host.world.gravity = {0.0, -kG};
  AddSegment(&host, 0, 100.0, 1.0).velocity.vx = 2.0;
  host.AddDisk(1, {0.0, 0.5}, 0.5, 0.0);
  host.Step(50, kDt);
  EXPECT_EQ(host.body(1).velocity.vx, 0.0);
}

TEST(MovingWall, LiftCarriesADisk) {
  Host host({}, Exact());
  host.world.gravity = {0.0, -kG};
  AddSegment(&host, 0, 2.0, 0.3).velocity.vy = 0.5;
  host.AddDisk(1, {0.0, 0.5}, 0.5, 0.3);
  host.Step(100, kDt);
  EXPECT_NEAR(host.body(1).velocity.vy, 0.5, 1e-12);
  EXPECT_NEAR(host.body(1).pose.y - host.body(0).pose.y, 0.5, 0.5 * kDt);  // one half step was needed to meet it
}

// A turning paddle: wall point s from the axis moves with spin * s along the normal.
TEST(TurningWall, PaddleHitsWithItsLever) {
  for (const double friction : {0.0, 0.4}) {
    Host host({.normal_law = NormalLaw::kGap}, Exact());
    reference::Body& paddle = AddSegment(&host, 0, 5.0, friction);
    paddle.velocity.spin = 0.8;
    const reference::Body& disk = host.AddDisk(1, {3.0, 0.5}, 0.5, friction);
    host.Step(kDt);
    const double angle = 0.5 * kDt * 0.8;
    const Vec2 along{std::cos(angle), std::sin(angle)}, n{-along.y, along.x}, centre{3.0, 0.5};
    const double s = Dot(along, centre);
    EXPECT_NEAR(Dot(Linear(disk.velocity), n), 0.8 * s, 1e-13) << friction;
    EXPECT_NEAR(host.stepper().contacts().relative_velocity[0].x, 0.0, 1e-13);
    EXPECT_NEAR(paddle.pose.angle, kDt * 0.8, 1e-16);
    EXPECT_EQ(paddle.velocity.spin, 0.8);
    EXPECT_EQ(paddle.pose.x, 0.0);
  }
}

// A wheel of radius R below a disk of radius r: with ample friction the surfaces stick, v = -spin R / 3, w r = 2 v.
TEST(TurningWall, WheelDrivesByFriction) {
  Host host({}, Exact());
  host.world.gravity = {0.0, -kG};
  reference::Body wheel = reference::MakeWall(0);
  wheel.disks.push_back({{}, 2.0});
  wheel.friction = 1000.0;
  wheel.velocity.spin = 0.6;
  host.world.Add(wheel);
  const reference::Body& disk = host.AddDisk(1, {0.0, 2.5}, 0.5, 1000.0);
  const StepReport& report = host.Step(kDt);
  EXPECT_NEAR(disk.velocity.vx, -0.6 * 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(disk.velocity.spin * 0.5, -2.0 * 0.6 * 2.0 / 3.0, 1e-12);
  EXPECT_EQ(report.solve.sticking, 1);
}

// The same wheel as body A and as body B of its contact.
TEST(TurningWall, WheelDrivesAlikeFromBothSidesOfTheContact) {
  std::vector<Twist> velocities;
  for (const std::int64_t id : {0, 2}) {
    Host host({}, Exact());
    host.world.gravity = {0.0, -kG};
    reference::Body wheel = reference::MakeWall(id);
    wheel.disks.push_back({{}, 2.0});
    wheel.friction = 1000.0;
    wheel.velocity.spin = 0.6;
    host.world.Add(wheel);
    host.AddDisk(1, {0.0, 2.5}, 0.5, 1000.0);
    host.Step(kDt);
    velocities.push_back(host.body(1).velocity);
  }
  EXPECT_LT(velocities[0].vx, -0.1);
  EXPECT_NEAR(velocities[1].vx, velocities[0].vx, 1e-13);
  EXPECT_NEAR(velocities[1].spin, velocities[0].spin, 1e-13);
}

// The gap at the end of the step is that to the wall where it then is, whatever the disk's own turn.
TEST(TurningWall, FinalGapIsThatOfTheTurnedWall) {
  for (const std::int64_t id : {0, 2}) {
    Host host({.alert_distance = 0.5}, Exact());
    AddSegment(&host, id, 5.0, 0.0).velocity.spin = 0.8;
    const reference::Body& disk = host.AddDisk(1, {3.0, 0.7}, 0.5);
    host.body(1).velocity = {0.0, 4.0, 30.0};
    host.Step(kDt);
    const double angle = kDt * 0.8;
    ASSERT_EQ(host.stepper().contacts().size(), 1u);
    EXPECT_EQ(host.stepper().contacts().impulse[0].x, 0.0);
    const double height = Dot(Vec2{-std::sin(angle), std::cos(angle)}, Centre(disk.pose));
    EXPECT_NEAR(host.stepper().contacts().final_gap[0], height - 0.5, 1e-13) << "wall " << id;
  }
}

// Off-centre disks of a turning wall: the velocity of the touching point, with the arm of the member disk.
TEST(TurningWall, OffCentreDiskOfAWheel) {
  Host host({.normal_law = NormalLaw::kGap}, Exact());
  reference::Body wheel = reference::MakeWall(0, {1.0, 1.0, 0.0});
  wheel.disks.push_back({{2.0, 0.0}, 0.5});
  wheel.velocity.spin = 0.5;
  host.world.Add(wheel);
  const reference::Body& disk = host.AddDisk(1, {3.0, 2.0}, 0.5);  // above the member disk
  const StepReport& report = host.Step(kDt);
  const double angle = 0.5 * kDt * 0.5;
  const Vec2 arm{2.0 * std::cos(angle), 2.0 * std::sin(angle)};
  const Vec2 between = Vec2{3.0, 2.0} - (Vec2{1.0, 1.0} + arm), n = (1.0 / Norm(between)) * between;
  EXPECT_NEAR(Dot(Linear(disk.velocity), n), 0.5 * Cross(arm, n), 1e-13);
  EXPECT_EQ(report.solve.unknowns_per_body, 2);  // arms of walls cost the bodies nothing
}

TEST(TurningWall, SubdomainsDoNotMatter) {
  const auto run = [](const AlgorithmOptions& algorithm) {
    Host host({.normal_law = NormalLaw::kGap}, algorithm);
    host.world.gravity = {0.0, -kG};
    reference::Body& paddle = AddSegment(&host, 0, 8.0, 0.3);
    paddle.velocity = {0.1, 0.2, 0.05};
    for (int i = 0; i < 6; ++i) host.AddDisk(1 + i, {i * 1.0 - 2.5, 0.5}, 0.5, 0.3);
    host.Step(10, kDt);
    std::vector<double> out;
    for (int i = 1; i <= 6; ++i)
      out.insert(out.end(), {host.body(i).velocity.vx, host.body(i).velocity.vy, host.body(i).velocity.spin});
    return out;
  };
  NscddOptions nscdd;
  nscdd.stopping = Exact().stopping;
  nscdd.partition = {3, 2, 1};
  const std::vector<double> whole = run(Exact()), parts = run(nscdd);
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(whole[i], parts[i], 1e-9);
}

// A wall may be edited between steps, and body kinds may change.
TEST(MovingWall, HostMayStopIt) {
  Host host({}, Exact());
  AddSegment(&host, 0, 100.0, 0.0).velocity.vy = 1.0;
  host.AddDisk(1, {0.0, 0.6}, 0.5);
  host.Step(20, kDt);
  EXPECT_NEAR(host.body(1).velocity.vy, 1.0, 1e-12);
  host.body(0).velocity.vy = 0.0;
  host.Step(5, kDt);
  EXPECT_NEAR(host.body(1).velocity.vy, 1.0, 1e-12);
  host.body(1).kind = BodyKind::kPrescribed;
  const double y = host.body(1).pose.y;
  const StepReport& report = host.Step(10, kDt);
  EXPECT_EQ(report.bodies, 0);
  EXPECT_NEAR(host.body(1).pose.y, y + 0.1, 1e-12);
}

// A wall that stands is left where its host has it, also outside of the period and at its end; what moves is wrapped.
TEST(StandingWall, IsNotWrappedIntoThePeriod) {
  Host host({}, Exact());
  host.world.period = 10.0;
  host.world.gravity = {0.0, -kG};
  reference::Body& floor = AddSegment(&host, 0, 5.0, 0.3);
  floor.pose.x = 15.0;
  AddSegment(&host, 2, 1.0, 0.3).pose = {9.995, -3.0, 0.0};
  host.body(2).velocity.vx = 1.0;
  host.AddDisk(1, {9.9, 0.5}, 0.5, 0.3).velocity.vx = 30.0;
  host.Step(kDt);
  EXPECT_EQ(host.body(0).pose.x, 15.0);
  EXPECT_NEAR(host.body(2).pose.x, 0.005, 1e-12);
  EXPECT_LT(host.body(1).pose.x, 1.0);
  EXPECT_NEAR(host.body(1).pose.y, 0.5, 1e-12) << "the floor holds it";
}

}  // namespace
}  // namespace nscdd
