// SPDX-License-Identifier: Apache-2.0
// Hosts on several ranks: bodies removed, added and edited between steps, hosts that fail, continuation. Started on four ranks.

#include <mpi.h>

#include <cmath>
#include <limits>

#include "nscdd/mpi_communicator.h"
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

bool SameAsOnOneRank(const NscddOptions& options, const Edit& edit, Communicator* communicator) {
  RankedHost host({.clusters = true}, options, communicator);
  host.Step(5);
  edit(&host, communicator->rank() == communicator->size() - 1);
  host.Step(5);
  const auto rows = Gather(host);
  SerialCommunicator serial;
  RankedHost whole({.clusters = true}, options, &serial);
  whole.Step(5);
  edit(&whole, true);
  whole.Step(5);
  return rows == Gather(whole);
}

int CheckEdits(Communicator* c) {
  int failures = 0;
  const NscddOptions options = Strips(2, 3);
  failures += ReportCheck("no edit",
                          SameAsOnOneRank(
                              options, [](RankedHost*, bool) {}, c),
                          c);
  // Every fourth body goes, among them many with ghosts elsewhere.
  const Edit remove = [](RankedHost* host, bool) {
    for (std::int64_t id = 2; id < 122; id += 4) {
      if (host->Owns(id)) host->world.Remove(id);
    }
  };
  failures += ReportCheck("bodies removed by their owners", SameAsOnOneRank(options, remove, c), c);
  // Four bodies, one for each corner of the sample: at least three of them are far from the rank that adds them.
  const Edit add = [](RankedHost* host, bool first) {
    for (int k = 0; k < 4 && first; ++k) {
      reference::Body body = reference::MakeDisk(1000 + k, {k % 2 ? 23.0 : 1.0, k / 2 ? 30.0 : 18.2}, 0.5, 1.0);
      body.velocity.vy = -3.0;
      body.friction = 0.3;
      host->world.Add(body);
    }
  };
  failures += ReportCheck("bodies added on any rank", SameAsOnOneRank(options, add, c), c);
  const Edit push = [](RankedHost* host, bool) {
    for (std::int64_t id = 2; id < 122; id += 3) {
      if (!host->Owns(id)) continue;
      host->world.Find(id)->velocity = {1.0, 2.0, 3.0};
      host->world.Find(id)->force = {5.0, 1.0, 0.5};
      if (id % 2 == 0) host->world.Find(id)->pose.y += 0.01;
    }
    if (host->Owns(0)) host->world.Find(0)->velocity = {0.2, 0.0, 0.01};
  };
  failures += ReportCheck("velocities, loads and poses edited by the owners", SameAsOnOneRank(options, push, c), c);
  return failures;
}

int CheckContinuation(Communicator* c) {
  const NscddOptions options = Strips(3, 2);
  RankedHost host({}, options, c);
  host.Step(6);
  const std::vector<std::byte> saved = host.stepper->SaveState();
  std::vector<std::int64_t> ghosts;
  for (const reference::Body& b : host.world.bodies()) {
    if (!host.Owns(b.id)) ghosts.push_back(b.id);
  }
  RankedHost other({}, options, c);
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
  return ReportCheck("continuation from the owned bodies and the saved state", !ghosts.empty() && Gather(host) == Gather(other),
                     c);
}

/// What all ranks of a run leave behind, on every rank.
struct Saved {
  std::vector<reference::Body> bodies;
  std::vector<std::vector<std::byte>> parts;
};

Saved SaveAll(const RankedHost& host) {
  Saved saved;
  std::vector<std::vector<double>> rows = Gather(host);  // id, pose, velocity first
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
std::vector<std::vector<double>> GoOn(const Saved& saved, int shift, const NscddOptions& options, Communicator* c,
                                      bool live = false) {
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

int CheckContinuationOnOtherRanks(Communicator* c) {
  int failures = 0;
  const NscddOptions options = Strips(3, 2);
  RankedHost host({}, options, c);
  SerialCommunicator serial;
  RankedHost whole({}, options, &serial);
  host.Step(6);
  whole.Step(6);
  const Saved of_four = SaveAll(host), of_one = SaveAll(whole);
  whole.Step(6);
  const auto expected = Gather(whole);
  for (const int ranks : {1, 2, 3, 4}) {
    MPI_Comm part = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, c->rank() < ranks ? 0 : 1, 0, &part);
    MpiCommunicator group(part);
    const auto same = [&](const Saved& saved, int shift) {
      double mine = c->rank() >= ranks || GoOn(saved, shift, options, &group) == expected ? 1.0 : 0.0;
      c->AllReduceMin({&mine, 1});
      return mine == 1.0;
    };
    failures += ReportCheck(fmt::format("what 4 ranks saved goes on on {}", ranks), same(of_four, 0) && same(of_four, 1), c);
    double live = c->rank() >= ranks || GoOn(of_four, 1, options, &group, true) == expected ? 1.0 : 0.0;
    c->AllReduceMin({&live, 1});
    failures += ReportCheck(fmt::format("on {} with a solver that has stepped", ranks), live == 1.0, c);
    failures += ReportCheck(fmt::format("what 1 rank saved goes on on {}", ranks), same(of_one, 0) && same(of_one, 2), c);
    MPI_Comm_free(&part);
  }
  return failures;
}

// Every rank refuses, whichever was given the wrong part, and its solver is what it was.
int CheckWrongParts(Communicator* c) {
  const NscddOptions options = Strips(3, 2);
  RankedHost host({}, options, c), twin({}, options, c), later({}, options, c);
  host.Step(3);
  twin.Step(3);
  later.Step(4);
  const Saved saved = SaveAll(host), newer = SaveAll(later);
  int failures = 0;
  using Parts = std::vector<std::vector<std::byte>>;
  const auto refused = [&](const char* what, const Parts& parts, const std::string& fragment) {
    std::vector<std::span<const std::byte>> mine;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (static_cast<int>(i) % c->size() == c->rank()) mine.emplace_back(parts[i]);
    }
    const std::string refusal = RefusalOf([&] { host.stepper->LoadState(mine); });
    failures += ReportCheck(what, refusal.find(fragment) != std::string::npos, c, refusal);
  };
  const auto& p = saved.parts;
  refused("no part", {}, "no saved state");
  refused("a part is missing", {p[0], p[1], p[2]}, "4 ranks saved the state and 3 parts");
  refused("a part is there twice", {p[0], p[1], p[2], p[2]}, "give the part of every rank");
  refused("too many parts", {p[0], p[1], p[2], p[3], p[0]}, "4 ranks saved the state and 5 parts");
  refused("parts of two moments", {p[0], p[1], newer.parts[2], p[3]}, "of different moments");
  refused("a part is cut short", {p[0], {p[1].begin(), p[1].end() - 8}, p[2], p[3]}, "rank 1: ");
  host.Step(3);
  twin.Step(3);
  failures += ReportCheck("refused parts change nothing", Gather(host) == Gather(twin), c);
  return failures;
}

/// Sends the bodies over each other, so that they cross the cuts.
void Stir(RankedHost* host) {
  for (const test::BodyRow& b : test::Rows(host->stepper->bodies()))
    host->world.Find(b.id)->velocity = {b.id % 2 == 0 ? 8.0 : -8.0, 4.0, 0.0};
}

// The transport fails again and again, on one rank after the other, while bodies and ghosts cross the cuts.
int CheckFailuresOfTransport(Communicator* c) {
  constexpr int kSteps = 40;
  int failures = 0;
  SerialCommunicator serial;
  RankedHost whole({}, Strips(2, 3), &serial);
  for (int k = 0; k < kSteps; ++k) {
    if (k % 8 == 1) Stir(&whole);
    whole.Step(1);
  }
  const auto expected = Gather(whole);
  const std::pair<Fault, const char*> faults[] = {
      {Fault::kPack, "pack"}, {Fault::kInsert, "insert"}, {Fault::kRemove, "remove"}};
  for (const auto& [fault, name] : faults) {
    RankedHost host({}, Strips(2, 3), c);
    int refused = 0;
    for (int k = 0; k < kSteps; ++k) {
      if (k % 8 == 1) Stir(&host);
      const int culprit = k % c->size();
      if (c->rank() == culprit) host.adapter->FailOnceIn(fault, k / 4 % 3);
      const std::string refusal = RefusalOf([&] { host.Step(1); });
      host.adapter->FailOnceIn(Fault::kNone);
      if (refusal == fmt::format("rank {}: the platform lost its mind", culprit)) ++refused;
      if (!refusal.empty()) host.Step(1);
    }
    failures += ReportCheck(fmt::format("{} failures of {}", refused, name), refused >= 2, c);
    failures += ReportCheck(fmt::format("the run with failures of {}", name), Gather(host) == expected, c);
  }
  return failures;
}

// A failure on rank 2 is the same Error everywhere; once the cause is gone the run goes on as if nothing had been.
int CheckFailures(Communicator* c) {
  int failures = 0;
  const NscddOptions options = Strips(2, 3);
  SerialCommunicator serial;
  RankedHost whole({}, options, &serial);
  whole.Step(8);
  const auto expected = Gather(whole);
  const std::pair<Fault, const char*> faults[] = {{Fault::kRead, "read"}, {Fault::kPack, "pack"}, {Fault::kDetect, "detect"}};
  for (const auto& [fault, name] : faults) {
    RankedHost host({}, options, c);
    int refused = 0;
    for (int k = 0; k < 8; ++k) {
      if (k % 4 == 0) {  // at the first step too, when all bodies move
        if (c->rank() == 2) host.adapter->FailOnceIn(fault);
        const bool fires = fault != Fault::kPack || k == 0;
        if (fires) refused += RefusalOf([&] { host.Step(1); }) == "rank 2: the platform lost its mind";
        host.adapter->FailOnceIn(Fault::kNone);
      }
      host.Step(1);
    }
    failures += ReportCheck(fmt::format("failure of {} on one rank", name), refused == (fault == Fault::kPack ? 1 : 2), c);
    failures += ReportCheck(fmt::format("the run after a failure of {}", name), Gather(host) == expected, c);
  }
  failures += CheckFailuresOfTransport(c);
  RankedHost host({}, options, c);
  host.Step(1);
  const std::string odd = RefusalOf([&] { host.stepper->Step(c->rank() == 2 ? 0.02 : 0.01); });
  failures +=
      ReportCheck("time steps that differ", odd == "the ranks have time steps from 0.01 to 0.02 s; give all the same", c, odd);
  const std::string bad = RefusalOf([&] { host.stepper->Step(c->rank() == 2 ? -1.0 : 0.01); });
  failures += ReportCheck("a bad time step on one rank", bad.starts_with("rank 2: the time step is -1 s"), c, bad);
  host.Step(7);
  failures += ReportCheck("the run after bad time steps", Gather(host) == expected, c);
  if (c->rank() == 2) host.adapter->FailOnceIn(Fault::kCommit);
  const std::string refusal = RefusalOf([&] { host.Step(1); });
  failures += ReportCheck("failure of commit on one rank", refusal == "rank 2: the platform lost its mind", c, refusal);
  return failures;
}

// Weights that part by 1e23 leave a matrix of one rank's subdomain that cannot be factorised: refused on both, without waiting.
int CheckSingularMatrix(Communicator* c) {
  FeaOptions options;
  options.partition = {4, 1, 1};
  options.interface.solve = InterfaceSolve::kCg;
  options.interface.lambda = 1e8;
  options.interface.reference_mass = 1e15;
  reference::World world;
  if (c->rank() == 0) {
    for (int k = 0; k < 6; ++k) {
      reference::Body disk = reference::MakeDisk(k, {0.98 * k, 0.0}, 0.5, 1000.0);
      disk.velocity.vx = 3.0 - k;
      world.Add(disk);
    }
    for (int k = 6; k < 12; ++k) world.Add(reference::MakeDisk(k, {2.0 * k, 0.0}, 0.5, 1000.0));
  }
  reference::ReferenceAdapter adapter(&world);
  TimeStepper stepper({}, options, &adapter, c);
  const std::string refusal = RefusalOf([&] { stepper.Step(0.01); });
  return ReportCheck("a matrix that one rank cannot factorise", refusal.find("positive definite") != std::string::npos, c,
                     refusal);
}

int CheckBadHosts(Communicator* c) {
  int failures = CheckSingularMatrix(c);
  const NscddOptions options = Strips(2, 3);
  {
    // A number of one host, mended afterwards. What others removed at the same time stays removed.
    RankedHost host({}, options, c);
    SerialCommunicator serial;
    RankedHost whole({}, options, &serial);
    host.Step(3);
    whole.Step(3);
    const bool spoils = host.Owns(50);
    double culprit = spoils ? c->rank() : c->size();
    c->AllReduceMin({&culprit, 1});
    const Twist velocity = spoils ? host.world.Find(50)->velocity : Twist{};
    if (spoils) host.world.Find(50)->velocity.vx = std::numeric_limits<double>::quiet_NaN();
    for (std::int64_t id = 2; id < 50; id += 3) {
      if (host.Owns(id)) host.world.Remove(id);
      whole.world.Remove(id);
    }
    const std::string refusal = RefusalOf([&] { host.Step(1); });
    const bool named = refusal.starts_with(fmt::format("rank {}: ", culprit)) && refusal.find("50") != std::string::npos;
    failures += ReportCheck("not a number in one host", named, c, refusal);
    if (spoils) host.world.Find(50)->velocity = velocity;
    host.Step(3);
    whole.Step(3);
    failures += ReportCheck("the run after it", Gather(host) == Gather(whole), c);
  }
  {
    // What the solver cannot represent is written back nowhere.
    RankedHost host({}, options, c);
    host.Step(2);
    std::vector<std::pair<std::int64_t, double>> before;
    for (const reference::Body& b : host.world.bodies()) before.emplace_back(b.id, b.pose.y);
    if (host.Owns(120)) {
      host.world.Find(120)->force.fy = 1e308;
      host.world.Find(120)->mass = 1e-9;
    }
    const std::string refusal = RefusalOf([&] { host.Step(1); });
    bool same = refusal.find("120") != std::string::npos;
    for (const auto& [id, y] : before) {
      const reference::Body* body = host.world.Find(id);
      if (body != nullptr) same = same && body->pose.y == y;
    }
    failures += ReportCheck("an infinite velocity is not committed on any rank", same, c, refusal);
  }
  {
    RankedHost host({}, options, c);
    host.Step(3);
    std::int64_t ghost = -1;
    for (const reference::Body& b : host.world.bodies()) {
      if (c->rank() == 1 && !host.Owns(b.id) && b.kind == BodyKind::kFree) ghost = b.id;
    }
    if (ghost >= 0) host.world.Remove(ghost);
    const std::string refusal = RefusalOf([&] { host.Step(1); });
    failures += ReportCheck("a ghost removed by the user", refusal.starts_with("rank 1: body "), c, refusal);
  }
  return failures;
}

int CheckRefusals(Communicator* c) {
  int failures = 0;
  const std::string many = RefusalOf([&] { RankedHost({}, Strips(1, 3), c); });
  failures += ReportCheck("more ranks than subdomains", many.find("4 ranks share 3 subdomains") != std::string::npos, c, many);
  // The same id on two ranks, whether the two bodies meet on a rank or are far apart, at first or later.
  for (const bool later : {false, true}) {
    for (const double x : {3.0, 2000.0}) {
      RankedHost host({}, Strips(4, 1), c);
      if (later) host.Step(3);
      const std::int64_t id = later ? 2 : 5;  // never on rank 3
      if (c->rank() == 3) host.world.Add(reference::MakeDisk(id, {x, 300.0}, 0.5, 1.0));
      const std::string refusal = RefusalOf([&] { host.Step(1); });
      const bool named = refusal.find(fmt::format("body {} ", id)) != std::string::npos;
      failures += ReportCheck(fmt::format("one id on two ranks, x = {}{}", x, later ? ", added later" : ""), named, c, refusal);
    }
  }
  return failures;
}

}  // namespace
}  // namespace nscdd::test

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int failures = 0;
  {
    using namespace nscdd::test;
    nscdd::MpiCommunicator communicator(MPI_COMM_WORLD);
    for (const auto check : {CheckEdits, CheckContinuation, CheckContinuationOnOtherRanks, CheckWrongParts, CheckFailures,
                             CheckBadHosts, CheckRefusals}) {
      const std::string unexpected = RefusalOf([&] { failures += check(&communicator); });  // the same on all ranks
      failures += ReportCheck("no unexpected error", unexpected.empty(), &communicator, unexpected);
    }
  }
  MPI_Finalize();
  return failures == 0 ? 0 : 1;
}
