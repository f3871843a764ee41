// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace nscdd {

/// The processes that write one set of results together. Without MPI there is one, and no MPI function is called.
///
/// Every function here and every function that takes a RankGroup is collective: all ranks call it in the same order.
class RankGroup {
 public:
  /// One process; MPI may be uninitialised.
  RankGroup() = default;
  /// The ranks of `communicator`, which whoever initialised MPI keeps alive and uses for nothing else meanwhile.
  explicit RankGroup(MPI_Comm communicator);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  bool is_serial() const { return size_ == 1; }
  MPI_Comm communicator() const { return communicator_; }

  /// Runs `work` on the calling ranks and makes an Error of one of them the same Error on all of them (the first rank's).
  void RunTogether(const std::function<void()>& work) const;
  /// The same, but `work` runs on rank 0 only.
  void RunOnRoot(const std::function<void()>& work) const;

  std::int64_t Sum(std::int64_t value) const;
  std::int64_t Min(std::int64_t value) const;
  double MinOfReals(double value) const;
  /// Sum of `value` over the lower ranks.
  std::int64_t SumOfLowerRanks(std::int64_t value) const;
  /// All ranks' bytes one behind the other on rank 0, empty elsewhere. Less than 2 GiB in all.
  std::vector<std::byte> GatherOnRoot(const std::vector<std::byte>& bytes) const;
  /// Calls `take` on every rank with each rank's bytes in order of rank; holds those of one. Less than 2 GiB a rank.
  void ShowToAll(std::span<const std::byte> bytes, const std::function<void(std::span<const std::byte>)>& take) const;
  /// Calls `take` on rank 0 with each rank's bytes in order of rank, in pieces; holds one piece. Throws Error on all ranks if
  /// `take` did.
  void PassToRoot(std::span<const std::byte> bytes, const std::function<void(std::span<const std::byte>)>& take) const;

 private:
  void Agree(const std::string& sentence, bool failed) const;

  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace nscdd
