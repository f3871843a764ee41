// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include "nscdd/communicator.h"

namespace nscdd {

/// Communicator over MPI. The only public header that includes mpi.h.
class MpiCommunicator final : public Communicator {
 public:
  /// Duplicates `parent`; MPI must be initialised, and not finalised before this object is destroyed. Collective.
  explicit MpiCommunicator(MPI_Comm parent);
  ~MpiCommunicator() override;
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  MPI_Comm handle() const { return comm_; }
  void AllReduceMin(std::span<double> values) override;
  std::vector<double> AllGather(std::span<const double> values) override;
  void Broadcast(int root, std::vector<std::byte>* bytes) override;
  std::vector<Message> Deliver(std::vector<Message> outgoing) override;
  void Exchange(std::span<const Outgoing> outgoing, std::span<const Incoming> incoming) override;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace nscdd
