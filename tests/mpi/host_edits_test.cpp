// SPDX-License-Identifier: Apache-2.0
// Hosts on several ranks: bodies removed, added and edited between steps, hosts that fail, continuation.

#include <fmt/format.h>
#include <mpi.h>

#include <cmath>
#include <limits>

#include "mpi_test.h"
#include "ranked_host.h"
#include "rows.h"

namespace nscdd::test {
namespace {

using Fault = FaultyAdapter::Fault;

NscddOptions Strips(int nx, int ny) {
  NscddOptions o;
  o.partition = {nx, ny, 1};
  o.stopping.max_iterations = 200;
  return o;
}

/// An edit by the host's user after step 5 of 10; `first` is true on exactly one rank.
using Edit = std::function<void(RankedHost* host, bool first)>;

using Rows = std::vector<std::vector<double>>;

class Edits : public MpiTest {
 protected:
  void ExpectSameAsOnOneRank(const Edit& edit) {
    const NscddOptions options = Strips(2, 3);
    RankedHost host({.clusters = true}, options, &communicator);
    host.Step(5);
    edit(&host, communicator.rank() == communicator.size() - 1);
    host.Step(5);
    const Rows rows = Gather(host);
    SerialCommunicator serial;
    RankedHost whole({.clusters = true}, options, &serial);
    whole.Step(5);
    edit(&whole, true);
    whole.Step(5);
    EXPECT_EQ(rows, Gather(whole));
  }
};

TEST_F(Edits, None) {
  ExpectSameAsOnOneRank([](RankedHost*, bool) {});
}

// Every fourth body goes, among them many with ghosts elsewhere.
TEST_F(Edits, RemovedByTheOwners) {
  ExpectSameAsOnOneRank([](RankedHost* host, bool) {
    for (std::int64_t id = 2; id < 122; id += 4) {
      if (host->Owns(id)) host->world.Remove(id);
    }
  });
}

// Four bodies, one for each corner of the sample: at least three of them are far from the rank that adds them.
TEST_F(Edits, AddedOnAnyRank) {
  ExpectSameAsOnOneRank([](RankedHost* host, bool first) {
    for (int k = 0; k < 4 && first; ++k) {
      reference::Body body = reference::MakeDisk(1000 + k, {k % 2 ? 23.0 : 1.0, k / 2 ? 30.0 : 18.2}, 0.5, 1.0);
      body.velocity.vy = -3.0;
      body.friction = 0.3;
      host->world.Add(body);
    }
  });
}

TEST_F(Edits, VelocitiesLoadsAndPosesByTheOwners) {
  ExpectSameAsOnOneRank([](RankedHost* host, bool) {
    for (std::int64_t id = 2; id < 122; id += 3) {
      if (!host->Owns(id)) continue;
      host->world.Find(id)->velocity = {1.0, 2.0, 3.0};
      host->world.Find(id)->force = {5.0, 1.0, 0.5};
      if (id % 2 == 0) host->world.Find(id)->pose.y += 0.01;
    }
    if (host->Owns(0)) host->world.Find(0)->velocity = {0.2, 0.0, 0.01};
  });
}

class Continuation : public MpiTest {};

TEST_F(Continuation, OfTheOwnedBodiesAndTheSavedState) {
  const NscddOptions options = Strips(3, 2);
  RankedHost host({}, options, &communicator);
  host.Step(6);
  const std::vector<std::byte> saved = host.stepper->SaveState();
  std::size_t ghosts = 0;  // which the other host lacks
  for (const reference::Body& b : host.world.bodies()) ghosts += !host.Owns(b.id);
  EXPECT_GT(ghosts, 0U);
  RankedHost other({}, options, &communicator);
  for (const reference::Body& b : MakeBodies({})) {
    if (other.world.Find(b.id) != nullptr) other.world.Remove(b.id);
  }
  for (const reference::Body& b : host.world.bodies()) {
    if (host.Owns(b.id)) other.world.Add(b);
  }
  other.Start(options);
  other.stepper->LoadState(saved);
  host.Step(6);
  other.Step(6);
  EXPECT_EQ(Gather(host), Gather(other));
}

/// What all ranks of a run leave behind, on every rank.
struct Saved {
  std::vector<reference::Body> bodies;
  std::vector<std::vector<std::byte>> parts;
};

Saved SaveAll(const RankedHost& host) {
  Saved saved;
  const Rows rows = Gather(host);  // id, pose, velocity first
  const std::vector<reference::Body> all = MakeBodies({});
  for (const auto& row : rows) {
    reference::Body body = *std::ranges::find(all, static_cast<std::int64_t>(row[0]), &reference::Body::id);
    body.pose = {row[1], row[2], row[3]};
    body.velocity = {row[4], row[5], row[6]};
    saved.bodies.push_back(body);
  }
  for (int rank = 0; rank < host.communicator->size(); ++rank) {
    std::vector<std::byte> part;
    if (rank == host.communicator->rank()) part = host.stepper->SaveState();
    host.communicator->Broadcast(rank, &part);
    saved.parts.push_back(std::move(part));
  }
  return saved;
}

/// Goes on from `saved` on the ranks of `c`: body k on rank (7 k + 1) % size, part i on rank (i + shift) % size. `live`: with a
/// solver that has made steps of its own.
Rows GoOn(const Saved& saved, int shift, const NscddOptions& options, Communicator* c, bool live = false) {
  RankedHost host({}, options, c);
  if (live) host.Step(2);
  const auto is_mine = [c](std::size_t number) { return static_cast<int>(number) % c->size() == c->rank(); };
  for (const reference::Body& b : saved.bodies) {
    if (host.world.Find(b.id) != nullptr) host.world.Remove(b.id);
  }
  for (std::size_t k = 0; k < saved.bodies.size(); ++k) {
    if (is_mine(7 * k + 1)) host.world.Add(saved.bodies[k]);
  }
  if (!live) host.Start(options);
  std::vector<std::span<const std::byte>> mine;
  for (std::size_t i = 0; i < saved.parts.size(); ++i) {
    if (is_mine(i + static_cast<std::size_t>(shift))) mine.emplace_back(saved.parts[i]);
  }
  host.stepper->LoadState(mine);
  host.Step(6);
  return Gather(host);
}

/// Goes on on the first ranks of them; the parameter says how many.
class ContinuationOn : public MpiTestWithParam<int> {
 protected:
  ContinuationOn() { MPI_Comm_split(communicator.handle(), communicator.rank() < GetParam() ? 0 : 1, 0, &part_); }
  ~ContinuationOn() override { MPI_Comm_free(&part_); }

  void SetUp() override {
    SerialCommunicator serial;
    RankedHost whole({}, options, &serial);
    whole.Step(6);
    of_one = SaveAll(whole);
    whole.Step(6);
    expected = Gather(whole);
    RankedHost host({}, options, &communicator);
    host.Step(6);
    of_four = SaveAll(host);
  }

  void ExpectToGoOn(const Saved& saved, int shift, bool live = false) {
    if (communicator.rank() >= GetParam()) return;
    MpiCommunicator group(part_);
    EXPECT_EQ(GoOn(saved, shift, options, &group, live), expected) << "parts shifted by " << shift;
  }

  const NscddOptions options = Strips(3, 2);
  Saved of_one, of_four;
  Rows expected;

 private:
  MPI_Comm part_ = MPI_COMM_NULL;
};

TEST_P(ContinuationOn, OfWhatFourRanksSaved) {
  ExpectToGoOn(of_four, 0);
  ExpectToGoOn(of_four, 1);
}

TEST_P(ContinuationOn, ByASolverThatHasStepped) { ExpectToGoOn(of_four, 1, true); }

TEST_P(ContinuationOn, OfWhatOneRankSaved) {
  ExpectToGoOn(of_one, 0);
  ExpectToGoOn(of_one, 2);
}

INSTANTIATE_TEST_SUITE_P(Ranks, ContinuationOn, testing::Values(1, 2, 3, 4), testing::PrintToStringParamName());

// Every rank refuses, whichever was given the wrong part, and its solver is what it was.
TEST_F(Continuation, OfWrongPartsIsRefusedAndChangesNothing) {
  const NscddOptions options = Strips(3, 2);
  RankedHost host({}, options, &communicator), twin({}, options, &communicator), later({}, options, &communicator);
  host.Step(3);
  twin.Step(3);
  later.Step(4);
  const std::vector<std::vector<std::byte>> p = SaveAll(host).parts, newer = SaveAll(later).parts;
  const auto refusal_of = [&](const std::vector<std::vector<std::byte>>& parts) {
    std::vector<std::span<const std::byte>> mine;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (static_cast<int>(i) % communicator.size() == communicator.rank()) mine.emplace_back(parts[i]);
    }
    return RefusalOf([&] { host.stepper->LoadState(mine); });
  };
  EXPECT_TRUE(Says(refusal_of({}), "no saved state"));
  EXPECT_TRUE(Says(refusal_of({p[0], p[1], p[2]}), "4 ranks saved the state and 3 parts"));
  EXPECT_TRUE(Says(refusal_of({p[0], p[1], p[2], p[2]}), "give the part of every rank"));
  EXPECT_TRUE(Says(refusal_of({p[0], p[1], p[2], p[3], p[0]}), "4 ranks saved the state and 5 parts"));
  EXPECT_TRUE(Says(refusal_of({p[0], p[1], newer[2], p[3]}), "of different moments"));
  EXPECT_TRUE(Says(refusal_of({p[0], {p[1].begin(), p[1].end() - 8}, p[2], p[3]}), "rank 1: "));
  host.Step(3);
  twin.Step(3);
  EXPECT_EQ(Gather(host), Gather(twin));
}

/// Sends the bodies over each other, so that they cross the cuts.
void Stir(RankedHost* host) {
  for (const test::BodyRow& b : test::Rows(host->stepper->bodies()))
    host->world.Find(b.id)->velocity = {b.id % 2 == 0 ? 8.0 : -8.0, 4.0, 0.0};
}

struct NamedFault {
  const char* name;
  Fault fault;
  friend void PrintTo(const NamedFault& fault, std::ostream* out) { *out << fault.name; }
};

class Failures : public MpiTestWithParam<NamedFault> {};
class FailuresOfTransport : public MpiTestWithParam<NamedFault> {};

// The transport fails again and again, on one rank after the other, while bodies and ghosts cross the cuts.
TEST_P(FailuresOfTransport, LeaveTheRunAsItWas) {
  constexpr int kSteps = 40;
  SerialCommunicator serial;
  RankedHost whole({}, Strips(2, 3), &serial), host({}, Strips(2, 3), &communicator);
  int refused = 0;
  for (int k = 0; k < kSteps; ++k) {
    if (k % 8 == 1) Stir(&whole);
    whole.Step(1);
    if (k % 8 == 1) Stir(&host);
    const int culprit = k % communicator.size();
    if (communicator.rank() == culprit) host.adapter->FailOnceIn(GetParam().fault, k / 4 % 3);
    const std::string refusal = RefusalOf([&] { host.Step(1); });
    host.adapter->FailOnceIn(Fault::kNone);
    if (refusal == fmt::format("rank {}: the platform lost its mind", culprit)) ++refused;
    if (!refusal.empty()) host.Step(1);
  }
  EXPECT_GE(refused, 2);
  EXPECT_EQ(Gather(host), Gather(whole));
}

INSTANTIATE_TEST_SUITE_P(Faults, FailuresOfTransport,
                         testing::Values(NamedFault{"pack", Fault::kPack}, NamedFault{"insert", Fault::kInsert},
                                         NamedFault{"remove", Fault::kRemove}),
                         testing::PrintToStringParamName());

// A failure on rank 2 is the same Error everywhere; once the cause is gone the run goes on as if nothing had been.
TEST_P(Failures, OnOneRankAreTheSameErrorEverywhere) {
  const Fault fault = GetParam().fault;
  SerialCommunicator serial;
  RankedHost whole({}, Strips(2, 3), &serial), host({}, Strips(2, 3), &communicator);
  whole.Step(8);
  for (int k = 0; k < 8; ++k) {
    if (k == 0 || (k == 4 && fault != Fault::kPack)) {  // bodies are packed at the first step, when all of them move
      if (communicator.rank() == 2) host.adapter->FailOnceIn(fault);
      EXPECT_EQ(RefusalOf([&] { host.Step(1); }), "rank 2: the platform lost its mind") << "step " << k;
      host.adapter->FailOnceIn(Fault::kNone);
    }
    host.Step(1);
  }
  EXPECT_EQ(Gather(host), Gather(whole));
}

INSTANTIATE_TEST_SUITE_P(Faults, Failures,
                         testing::Values(NamedFault{"read", Fault::kRead}, NamedFault{"pack", Fault::kPack},
                                         NamedFault{"detect", Fault::kDetect}),
                         testing::PrintToStringParamName());

class BadCalls : public MpiTest {};

TEST_F(BadCalls, TimeStepsAreRefusedEverywhereAndChangeNothing) {
  SerialCommunicator serial;
  RankedHost whole({}, Strips(2, 3), &serial), host({}, Strips(2, 3), &communicator);
  whole.Step(8);
  host.Step(1);
  EXPECT_EQ(RefusalOf([&] { host.stepper->Step(communicator.rank() == 2 ? 0.02 : 0.01); }),
            "the ranks have time steps from 0.01 to 0.02 s; give all the same");
  const std::string bad = RefusalOf([&] { host.stepper->Step(communicator.rank() == 2 ? -1.0 : 0.01); });
  EXPECT_TRUE(bad.starts_with("rank 2: the time step is -1 s")) << bad;
  host.Step(7);
  EXPECT_EQ(Gather(host), Gather(whole));
}

class BadHosts : public MpiTest {};

TEST_F(BadHosts, FailureOfCommit) {
  RankedHost host({}, Strips(2, 3), &communicator);
  host.Step(8);
  if (communicator.rank() == 2) host.adapter->FailOnceIn(Fault::kCommit);
  EXPECT_EQ(RefusalOf([&] { host.Step(1); }), "rank 2: the platform lost its mind");
}

// Weights that part by 1e23 leave a matrix of one rank's subdomain that cannot be factorised: refused on both, without waiting.
TEST_F(BadHosts, MatrixThatOneRankCannotFactorise) {
  FeaOptions options;
  options.partition = {4, 1, 1};
  options.interface.solve = InterfaceSolve::kCg;
  options.interface.lambda = 1e8;
  options.interface.reference_mass = 1e15;
  reference::World world;
  if (communicator.rank() == 0) {
    for (int k = 0; k < 6; ++k) {
      reference::Body disk = reference::MakeDisk(k, {0.98 * k, 0.0}, 0.5, 1000.0);
      disk.velocity.vx = 3.0 - k;
      world.Add(disk);
    }
    for (int k = 6; k < 12; ++k) world.Add(reference::MakeDisk(k, {2.0 * k, 0.0}, 0.5, 1000.0));
  }
  reference::ReferenceAdapter adapter(&world);
  TimeStepper stepper({}, options, &adapter, &communicator);
  EXPECT_TRUE(Says(RefusalOf([&] { stepper.Step(0.01); }), "positive definite"));
}

// Mended afterwards, the run goes on. What others removed at the same time stays removed.
TEST_F(BadHosts, NotANumberInOneHost) {
  RankedHost host({}, Strips(2, 3), &communicator);
  SerialCommunicator serial;
  RankedHost whole({}, Strips(2, 3), &serial);
  host.Step(3);
  whole.Step(3);
  const bool spoils = host.Owns(50);
  double culprit = spoils ? communicator.rank() : communicator.size();
  communicator.AllReduceMin({&culprit, 1});
  const Twist velocity = spoils ? host.world.Find(50)->velocity : Twist{};
  if (spoils) host.world.Find(50)->velocity.vx = std::numeric_limits<double>::quiet_NaN();
  for (std::int64_t id = 2; id < 50; id += 3) {
    if (host.Owns(id)) host.world.Remove(id);
    whole.world.Remove(id);
  }
  const std::string refusal = RefusalOf([&] { host.Step(1); });
  EXPECT_TRUE(refusal.starts_with(fmt::format("rank {}: ", culprit))) << refusal;
  EXPECT_TRUE(Says(refusal, "50"));
  if (spoils) host.world.Find(50)->velocity = velocity;
  host.Step(3);
  whole.Step(3);
  EXPECT_EQ(Gather(host), Gather(whole));
}

TEST_F(BadHosts, InfiniteVelocityIsCommittedOnNoRank) {
  RankedHost host({}, Strips(2, 3), &communicator);
  host.Step(2);
  std::vector<std::pair<std::int64_t, double>> before;
  for (const reference::Body& b : host.world.bodies()) before.emplace_back(b.id, b.pose.y);
  if (host.Owns(120)) {
    host.world.Find(120)->force.fy = 1e308;
    host.world.Find(120)->mass = 1e-9;
  }
  EXPECT_TRUE(Says(RefusalOf([&] { host.Step(1); }), "120"));
  for (const auto& [id, y] : before) {
    const reference::Body* body = host.world.Find(id);
    EXPECT_TRUE(body == nullptr || body->pose.y == y) << "body " << id;
  }
}

TEST_F(BadHosts, GhostRemovedByTheUser) {
  RankedHost host({}, Strips(2, 3), &communicator);
  host.Step(3);
  std::int64_t ghost = -1;
  for (const reference::Body& b : host.world.bodies()) {
    if (communicator.rank() == 1 && !host.Owns(b.id) && b.kind == BodyKind::kFree) ghost = b.id;
  }
  if (ghost >= 0) host.world.Remove(ghost);
  const std::string refusal = RefusalOf([&] { host.Step(1); });
  EXPECT_TRUE(refusal.starts_with("rank 1: body ")) << refusal;
}

TEST_F(BadHosts, MoreRanksThanSubdomains) {
  EXPECT_TRUE(Says(RefusalOf([&] { RankedHost({}, Strips(1, 3), &communicator); }), "4 ranks share 3 subdomains"));
}

// Whether the two bodies meet on a rank or are far apart, at first or later.
TEST_F(BadHosts, OneIdOnTwoRanks) {
  for (const bool later : {false, true}) {
    for (const double x : {3.0, 2000.0}) {
      RankedHost host({}, Strips(4, 1), &communicator);
      if (later) host.Step(3);
      const std::int64_t id = later ? 2 : 5;  // never on rank 3
      if (communicator.rank() == 3) host.world.Add(reference::MakeDisk(id, {x, 300.0}, 0.5, 1.0));
      EXPECT_TRUE(Says(RefusalOf([&] { host.Step(1); }), fmt::format("body {} ", id))) << "x = " << x << ", later: " << later;
    }
  }
}

}  // namespace
}  // namespace nscdd::test
