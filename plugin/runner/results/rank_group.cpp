#include "results/rank_group.h"

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

std::int64_t RankGroup::SumOfLowerRanks(std::int64_t value) const {
  std::int64_t sum = 0;
  if (!is_serial()) MPI_Exscan(&value, &sum, 1, MPI_INT64_T, MPI_SUM, communicator_);
  return is_root() ? 0 : sum;  // MPI leaves rank 0's sum undefined
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
