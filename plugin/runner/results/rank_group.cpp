// SPDX-License-Identifier: Apache-2.0
#include "results/rank_group.h"

#include <algorithm>
#include <exception>
#include <numeric>

#include "nscdd/error.h"

namespace nscdd {

RankGroup::RankGroup(MPI_Comm communicator) : communicator_(communicator) {
  MPI_Comm_rank(communicator, &rank_);
  MPI_Comm_size(communicator, &size_);
}

void RankGroup::RunTogether(const std::function<void()>& work) const {
  std::string sentence;
  bool failed = false;
  try {
    work();
  } catch (const std::exception& error) {
    sentence = error.what();
    failed = true;
  }
  Agree(sentence, failed);
}

void RankGroup::RunOnRoot(const std::function<void()>& work) const {
  RunTogether([&] {
    if (is_root()) work();
  });
}

void RankGroup::Agree(const std::string& sentence, bool failed) const {
  const auto speaker = static_cast<int>(Min(failed ? rank_ : size_));
  if (speaker == size_) return;
  std::string agreed = sentence;
  if (!is_serial()) {
    auto length = static_cast<std::int64_t>(agreed.size());
    MPI_Bcast(&length, 1, MPI_INT64_T, speaker, communicator_);
    agreed.resize(static_cast<std::size_t>(length));
    MPI_Bcast(agreed.data(), static_cast<int>(length), MPI_CHAR, speaker, communicator_);
  }
  throw Error(agreed);
}

std::int64_t RankGroup::Sum(std::int64_t value) const {
  if (!is_serial()) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, communicator_);
  return value;
}

std::int64_t RankGroup::Min(std::int64_t value) const {
  if (!is_serial()) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_MIN, communicator_);
  return value;
}

double RankGroup::MinOfReals(double value) const {
  if (!is_serial()) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MIN, communicator_);
  return value;
}

void RankGroup::ShowToAll(std::span<const std::byte> bytes, const std::function<void(std::span<const std::byte>)>& take) const {
  if (is_serial()) return take(bytes);
  std::vector<std::byte> shown;
  for (int speaker = 0; speaker < size_; ++speaker) {
    auto count = static_cast<std::int64_t>(bytes.size());
    MPI_Bcast(&count, 1, MPI_INT64_T, speaker, communicator_);
    shown.assign(bytes.begin(), bytes.end());
    shown.resize(static_cast<std::size_t>(count));
    MPI_Bcast(shown.data(), static_cast<int>(count), MPI_BYTE, speaker, communicator_);
    take(shown);
  }
}

std::int64_t RankGroup::SumOfLowerRanks(std::int64_t value) const {
  std::int64_t sum = 0;
  if (!is_serial()) MPI_Exscan(&value, &sum, 1, MPI_INT64_T, MPI_SUM, communicator_);
  return is_root() ? 0 : sum;  // MPI leaves rank 0's sum undefined
}

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 24;  // [bytes]

/// The pieces of `size` bytes, the last one maybe shorter, and one at least.
template <class Function>
void ForEachPiece(std::size_t size, Function&& f) {
  std::size_t first = 0;
  do {
    const std::size_t count = std::min(kPiece, size - first);
    f(first, count);
    first += count;
  } while (first < size);
}

}  // namespace

void RankGroup::PassToRoot(std::span<const std::byte> bytes,
                           const std::function<void(std::span<const std::byte>)>& take) const {
  constexpr int kTag = 17;
  if (!is_root()) {
    const auto size = static_cast<std::uint64_t>(bytes.size());
    MPI_Send(&size, 1, MPI_UINT64_T, 0, kTag, communicator_);
    ForEachPiece(bytes.size(), [&](std::size_t first, std::size_t count) {
      MPI_Send(bytes.data() + first, static_cast<int>(count), MPI_BYTE, 0, kTag, communicator_);
    });
  }
  RunOnRoot([&] {
    std::exception_ptr failure;  // the other ranks' bytes are received all the same
    const auto try_to_take = [&](std::span<const std::byte> piece) {
      try {
        if (!failure) take(piece);
      } catch (...) {
        failure = std::current_exception();
      }
    };
    try_to_take(bytes);
    std::vector<std::byte> piece;
    for (int sender = 1; sender < size_; ++sender) {
      std::uint64_t size = 0;
      MPI_Recv(&size, 1, MPI_UINT64_T, sender, kTag, communicator_, MPI_STATUS_IGNORE);
      ForEachPiece(static_cast<std::size_t>(size), [&](std::size_t, std::size_t count) {
        piece.resize(count);
        MPI_Recv(piece.data(), static_cast<int>(count), MPI_BYTE, sender, kTag, communicator_, MPI_STATUS_IGNORE);
        try_to_take(piece);
      });
    }
    if (failure) std::rethrow_exception(failure);
  });
}

std::vector<std::byte> RankGroup::GatherOnRoot(const std::vector<std::byte>& bytes) const {
  if (is_serial()) return bytes;
  const auto count = static_cast<int>(bytes.size());
  std::vector<int> counts(is_root() ? size_ : 0), offsets(counts.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator_);
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  std::vector<std::byte> all(counts.empty() ? 0 : static_cast<std::size_t>(offsets.back() + counts.back()));
  MPI_Gatherv(bytes.data(), count, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, 0, communicator_);
  return all;
}

}  // namespace nscdd
