// SPDX-License-Identifier: Apache-2.0
// Impacts, fast bodies and joints: the same bits on every number of ranks, also after a state saved in mid-flight.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "mpi_test.h"
#include "nscdd/reference/reference_adapter.h"
#include "nscdd/time_stepper.h"
#include "random.h"

namespace nscdd::contact_law {
namespace {

using ContactLawRanks = test::MpiTest;

constexpr double kDt = 0.01, kPeriod = 6.0;

/// A gas over a floor of pieces and under a moving ceiling, disks that cross up to a third of it in a step; periodic, or
/// between walls.
std::vector<reference::Body> MakeBodies(bool periodic) {
  Random random(17);
  std::vector<reference::Body> bodies;
  for (int i = 0; i < 6; ++i) {
    bodies.push_back(reference::MakeWall(i, {static_cast<double>(i), 0.0, 0.0}));
    bodies.back().segments = {{{0.0, 0.0}, {1.0, 0.0}}};
  }
  bodies.push_back(reference::MakeWall(6, {0.0, 6.0, 0.0}));
  bodies.back().segments = {{{0.0, 0.0}, {kPeriod, 0.0}}};
  bodies.back().velocity = {0.0, -0.5, 0.0};
  if (!periodic) {
    bodies.push_back(reference::MakeWall(7, {}));
    bodies.back().segments = {{{0.0, 0.0}, {0.0, 6.0}}, {{kPeriod, 0.0}, {kPeriod, 6.0}}};
  }
  for (int i = 0; i < 30; ++i) {
    const Vec2 at{0.5 + i % 6 + random.Uniform(-0.2, 0.2), 0.5 + i / 6 + random.Uniform(-0.2, 0.2)};
    bodies.push_back(reference::MakeDisk(10 + i, at, random.Uniform(0.1, 0.25), 1.0));
    const Vec2 v = random.LogUniform(1.0, 200.0) * random.Direction();
    bodies.back().velocity = {v.x, v.y, random.Uniform(-5.0, 5.0)};
  }
  for (reference::Body& body : bodies) {
    body.restitution = body.id % 3 == 0 ? 0.9 : 0.6;
    body.friction = 0.3;
  }
  return bodies;
}

/// Id, pose and velocity of every body.
using Rows = std::map<std::int64_t, std::pair<Pose, Twist>>;

/// One rank's part of a run.
struct RankRun {
  RankRun(bool periodic, const Rows* begin, Communicator* c) : communicator(c) {
    world.gravity = {0.0, -9.81};
    if (periodic) world.period = kPeriod;
    const std::vector<reference::Body> all = MakeBodies(periodic);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (static_cast<int>(k) % c->size() != c->rank()) continue;
      reference::Body& body = world.Add(all[k]);
      if (begin) std::tie(body.pose, body.velocity) = begin->at(body.id);
    }
    NscddOptions options;
    options.partition = {2, 2, 1};
    options.stopping.max_iterations = 300;
    adapter = std::make_unique<reference::ReferenceAdapter>(&world);
    SteppingOptions stepping;
    stepping.normal_law = NormalLaw::kImpact;
    stepper = std::make_unique<TimeStepper>(stepping, options, adapter.get(), c);
  }
  void Step(int count) {
    for (int k = 0; k < count; ++k) energy.push_back(stepper->Step(kDt).kinetic_energy);
  }
  Rows Gather() const {
    const BodyResults& b = stepper->bodies();
    std::vector<double> mine;
    for (std::size_t i = 0; i < b.size(); ++i) {
      mine.insert(mine.end(), {static_cast<double>(b.id[i]), b.pose[i].x, b.pose[i].y, b.pose[i].angle, b.velocity[i].vx,
                               b.velocity[i].vy, b.velocity[i].spin});
    }
    const std::vector<double> all = communicator->AllGather(mine);
    Rows rows;
    for (std::size_t i = 0; i < all.size(); i += 7) {
      const double* r = &all[i];
      rows[static_cast<std::int64_t>(r[0])] = {{r[1], r[2], r[3]}, {r[4], r[5], r[6]}};
    }
    return rows;
  }

  Communicator* communicator;
  reference::World world;
  std::unique_ptr<reference::ReferenceAdapter> adapter;
  std::unique_ptr<TimeStepper> stepper;
  std::vector<double> energy;
};

void ExpectSame(const Rows& one, const Rows& other, const char* what) {
  ASSERT_EQ(one.size(), other.size()) << what;
  for (const auto& [id, row] : one) {
    const auto& [q, v] = row;
    const auto& [p, u] = other.at(id);
    EXPECT_TRUE(q.x == p.x && q.y == p.y && q.angle == p.angle && v.vx == u.vx && v.vy == u.vy && v.spin == u.spin)
        << what << ", body " << id << ": (" << q.x << ", " << q.y << ") and (" << p.x << ", " << p.y << "), velocities ("
        << v.vx << ", " << v.vy << ") and (" << u.vx << ", " << u.vy << ")";
  }
}

std::vector<std::vector<std::byte>> GatherParts(const std::vector<std::byte>& mine, Communicator* communicator) {
  std::vector<double> numbers{static_cast<double>(mine.size())};
  for (const std::byte b : mine) numbers.push_back(std::to_integer<int>(b));
  const std::vector<double> all = communicator->AllGather(numbers);
  std::vector<std::vector<std::byte>> parts;
  for (std::size_t i = 0; i < all.size();) {
    const auto size = static_cast<std::size_t>(all[i++]);
    parts.emplace_back();
    for (std::size_t k = 0; k < size; ++k) parts.back().push_back(static_cast<std::byte>(static_cast<int>(all[i++])));
  }
  return parts;
}

void ExpectSameBits(bool periodic, Communicator* communicator) {
  constexpr int kHalf = 20;
  RankRun run(periodic, nullptr, communicator);
  run.Step(kHalf);
  const Rows middle = run.Gather();
  const std::vector<std::byte> part = run.stepper->SaveState();
  const std::vector<std::vector<std::byte>> parts = GatherParts(part, communicator);
  run.Step(kHalf);
  const Rows end = run.Gather();

  RankRun again(periodic, &middle, communicator);
  again.stepper->LoadState(part);
  again.Step(kHalf);
  ExpectSame(end, again.Gather(), "saved in mid-flight");

  if (communicator->rank() != 0) return;
  SerialCommunicator serial;
  RankRun alone(periodic, nullptr, &serial);
  alone.Step(2 * kHalf);
  ExpectSame(alone.Gather(), end, "without MPI");
  EXPECT_EQ(alone.energy, run.energy);

  RankRun fewer(periodic, &middle, &serial);
  const std::vector<std::span<const std::byte>> views(parts.begin(), parts.end());
  fewer.stepper->LoadState(std::span<const std::span<const std::byte>>(views));
  fewer.Step(kHalf);
  ExpectSame(end, fewer.Gather(), "saved in mid-flight, goes on without MPI");

  // A test of impacts: some bodies must have turned back.
  int turned = 0;
  for (const reference::Body& body : MakeBodies(periodic)) turned += body.velocity.vx * end.at(body.id).second.vx < 0.0;
  EXPECT_GT(turned, 5);
}

TEST_F(ContactLawRanks, SameBits) { ExpectSameBits(false, &communicator); }
TEST_F(ContactLawRanks, SameBitsPeriodic) { ExpectSameBits(true, &communicator); }

/// Bodies that cross several subdomains in a step meet whom they meet on one rank, and nobody leaves the box.
TEST_F(ContactLawRanks, NobodyEscapes) {
  RankRun run(false, nullptr, &communicator);
  for (int k = 0; k < 40; ++k) {
    run.Step(1);
    for (const auto& [id, row] : run.Gather()) {
      if (id < 10) continue;
      EXPECT_TRUE(row.first.x > 0.0 && row.first.x < kPeriod && row.first.y > 0.0 && row.first.y < 6.0)
          << "step " << k << ": body " << id << " is at (" << row.first.x << ", " << row.first.y << ")";
    }
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace nscdd::contact_law
