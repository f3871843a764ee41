// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nscdd {

/// Bytes for, or from, one rank.
struct Message {
  int rank = 0;
  std::vector<std::byte> bytes;
};

/// What a communicator did since it was made.
struct CommunicationCounters {
  std::int64_t messages = 0;     ///< sent to other ranks
  std::int64_t bytes = 0;        ///< in them
  std::int64_t collectives = 0;  ///< calls in which all ranks took part
  double seconds = 0.0;          ///< spent in the calls, waiting included
};

/// The ranks that solve one world together. Passed in by whoever started them; the core never looks for one.
/// All functions but rank() and size() are collective unless they say otherwise. Throws Error when the transport fails.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// Componentwise minimum over the ranks, in place; exact, so independent of their number.
  virtual void AllReduceMin(std::span<double> values) = 0;
  /// All ranks' values one behind the other in order of rank; their numbers may differ.
  virtual std::vector<double> AllGather(std::span<const double> values) = 0;
  /// Bytes of rank `root` on all ranks.
  virtual void Broadcast(int root, std::vector<std::byte>* bytes) = 0;
  /// Delivers messages to ranks that do not expect them. At most one to a rank, none to oneself; received in order of rank.
  virtual std::vector<Message> Deliver(std::vector<Message> outgoing) = 0;
  /// Exchanges doubles with neighbours that expect them (not collective: only the ranks named take part). Both lists name each
  /// neighbour at most once; incoming spans have the right size already.
  struct Outgoing {
    int rank;
    std::span<const double> values;
  };
  struct Incoming {
    int rank;
    std::span<double> values;
  };
  virtual void Exchange(std::span<const Outgoing> outgoing, std::span<const Incoming> incoming) = 0;

  const CommunicationCounters& counters() const { return counters_; }

 protected:
  CommunicationCounters counters_;
};

/// The only rank of a run without MPI: every function is the identity and costs nothing.
class SerialCommunicator final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void AllReduceMin(std::span<double>) override {}
  std::vector<double> AllGather(std::span<const double> values) override;
  void Broadcast(int, std::vector<std::byte>*) override {}
  std::vector<Message> Deliver(std::vector<Message>) override { return {}; }
  void Exchange(std::span<const Outgoing>, std::span<const Incoming>) override {}
};

}  // namespace nscdd
