// SPDX-License-Identifier: Apache-2.0
// Data and messages are local: a rank holds its subdomains' bodies and a halo, and talks to its neighbours. A tall sample in
// horizontal strips, so that a rank has two neighbours at most.

#include <set>

#include "mpi_test.h"
#include "ranked_host.h"

namespace nscdd::test {
namespace {

/// Notes to whom messages go.
class Recorder final : public Communicator {
 public:
  explicit Recorder(Communicator* inner) : inner_(inner) {}
  int rank() const override { return inner_->rank(); }
  int size() const override { return inner_->size(); }
  void AllReduceMin(std::span<double> values) override {
    inner_->AllReduceMin(values);
    counters_ = inner_->counters();
  }
  std::vector<double> AllGather(std::span<const double> values) override {
    largest_gather = std::max(largest_gather, values.size());
    auto all = inner_->AllGather(values);
    counters_ = inner_->counters();
    return all;
  }
  void Broadcast(int root, std::vector<std::byte>* bytes) override { inner_->Broadcast(root, bytes); }
  std::vector<Message> Deliver(std::vector<Message> outgoing) override {
    for (const Message& m : outgoing) delivered.insert(m.rank);
    auto incoming = inner_->Deliver(std::move(outgoing));
    counters_ = inner_->counters();
    return incoming;
  }
  void Exchange(std::span<const Outgoing> outgoing, std::span<const Incoming> incoming) override {
    ++exchanges;
    for (const auto& o : outgoing) exchanged.insert(o.rank);
    most_partners = std::max(most_partners, outgoing.size());
    inner_->Exchange(outgoing, incoming);
    counters_ = inner_->counters();
  }

  std::set<int> delivered, exchanged;
  std::size_t most_partners = 0, largest_gather = 0;
  int exchanges = 0;

 private:
  Communicator* inner_;
};

class Locality : public MpiTest {
 protected:
  static constexpr int kRows = 60, kColumns = 6, kSubdomains = 8;

  static NscddOptions Strips() {
    NscddOptions options;
    options.partition = {1, kSubdomains, 1};
    options.stopping.max_iterations = 50;
    options.stopping.tolerance = 1e-12;
    return options;
  }

  Recorder recorder{&communicator};
  RankedHost host{{.columns = kColumns, .rows = kRows}, Strips(), &recorder};
};

TEST_F(Locality, MessagesGoToNeighboursOnly) {
  host.Step(1);
  recorder.delivered.clear();
  recorder.largest_gather = 0;
  host.Step(5);
  const int me = communicator.rank(), last = communicator.size() - 1;
  const std::set<int> neighbours = me == 0 ? std::set{1} : me == last ? std::set{me - 1} : std::set{me - 1, me + 1};
  EXPECT_EQ(recorder.exchanged, neighbours) << "of the interface";
  EXPECT_EQ(recorder.most_partners, neighbours.size());
  EXPECT_GE(recorder.exchanges, 250);
  // The wall reaches along the whole sample: its owner tells everybody. Grains travel between neighbours only.
  const bool owns_wall = host.Owns(0);
  for (const int rank : recorder.delivered) EXPECT_TRUE(owns_wall || neighbours.contains(rank)) << "to rank " << rank;
  // Reductions: a few numbers per subdomain.
  EXPECT_LE(recorder.largest_gather, 18U * kSubdomains / 4);
}

TEST_F(Locality, ARankHoldsItsShareAndAHalo) {
  host.Step(6);
  // One wall, its subdomains' share and two layers of grains on either side.
  const std::size_t share = kRows * kColumns / 4, halo = 2 * 2 * kColumns;
  EXPECT_LE(host.world.size(), 1 + share * 5 / 4 + halo) << "of " << 1 + kRows * kColumns << " bodies";
}

TEST_F(Locality, MessagesAreCounted) {
  host.Step(1);
  for (int k = 0; k < 5; ++k) {
    const std::int64_t before = recorder.counters().messages;
    const StepReport& report = host.stepper->Step(0.01);
    const double mine = static_cast<double>(recorder.counters().messages - before);
    double sum = 0.0;
    for (const double one : communicator.AllGather({&mine, 1})) sum += one;
    EXPECT_EQ(static_cast<double>(report.messages), sum);
    EXPECT_GT(report.messages, 0);
    EXPECT_GT(report.message_bytes, 0);
    EXPECT_GT(report.collectives, 0);
  }
}

}  // namespace
}  // namespace nscdd::test
