// SPDX-License-Identifier: Apache-2.0
// Data and messages are local: a rank holds its subdomains' bodies and a halo, and talks to its neighbours. Four ranks, a tall
// sample in horizontal strips, so that a rank has two neighbours at most.

#include <mpi.h>

#include <set>

#include "nscdd/mpi_communicator.h"
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

int Check(Communicator* world) {
  constexpr int kRows = 60, kColumns = 6, kSubdomains = 8;
  Recorder recorder(world);
  NscddOptions options;
  options.partition = {1, kSubdomains, 1};
  options.stopping.max_iterations = 50;
  options.stopping.tolerance = 1e-12;
  RankedHost host({.columns = kColumns, .rows = kRows}, options, &recorder);
  host.Step(1);
  recorder.delivered.clear();
  recorder.largest_gather = 0;
  std::int64_t messages = 0;
  bool counted = true;
  for (int k = 0; k < 5; ++k) {
    const std::int64_t before = recorder.counters().messages;
    const StepReport& report = host.stepper->Step(0.01);
    const double mine = static_cast<double>(recorder.counters().messages - before);
    double sum = 0.0;
    for (const double one : world->AllGather({&mine, 1})) sum += one;
    counted = counted && static_cast<double>(report.messages) == sum && report.message_bytes > 0 && report.collectives > 0;
    messages += report.messages;
  }

  const int me = world->rank(), last = world->size() - 1;
  const std::set<int> neighbours = me == 0 ? std::set{1} : me == last ? std::set{me - 1} : std::set{me - 1, me + 1};
  int failures = 0;
  failures +=
      ReportCheck("interface exchanges with exactly the neighbours",
                  recorder.exchanged == neighbours && recorder.most_partners == neighbours.size() && recorder.exchanges >= 250,
                  world, fmt::format("{} exchanges", recorder.exchanges));
  // The wall reaches along the whole sample: its owner tells everybody.
  const bool owns_wall = host.Owns(0);
  bool local = true;
  for (const int rank : recorder.delivered) local = local && (owns_wall || neighbours.contains(rank));
  failures += ReportCheck("grains travel between neighbours only", local, world);
  // Reductions: a few numbers per subdomain.
  failures += ReportCheck("reductions are small", recorder.largest_gather <= 16 * kSubdomains / 4, world,
                          fmt::format("{} numbers at most", recorder.largest_gather));
  // One wall, its subdomains' share and two layers of grains on either side.
  const std::size_t share = kRows * kColumns / 4, halo = 2 * 2 * kColumns;
  failures += ReportCheck("a rank holds its share and a halo", host.world.size() <= 1 + share * 5 / 4 + halo, world,
                          fmt::format("{} of {} bodies", host.world.size(), 1 + kRows * kColumns));
  failures += ReportCheck("messages are counted", counted && messages > 0, world, fmt::format("{} in five steps", messages));
  return failures;
}

}  // namespace
}  // namespace nscdd::test

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int failures = 0;
  {
    nscdd::MpiCommunicator communicator(MPI_COMM_WORLD);
    failures = nscdd::test::Check(&communicator);
  }
  MPI_Finalize();
  return failures == 0 ? 0 : 1;
}
