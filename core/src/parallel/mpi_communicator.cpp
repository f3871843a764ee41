// SPDX-License-Identifier: Apache-2.0
#include "nscdd/mpi_communicator.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>

#include "nscdd/error.h"

namespace nscdd {
namespace {

constexpr int kTagExchange = 1;
constexpr int kTagDeliver = 2;  // and 3: two calls in a row may overlap

void Check(int code, const char* function) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw Error(fmt::format("{} failed: {}; a rank has probably died, see the launcher's output", function, text));
}

int Count(std::size_t size) {
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw Error(fmt::format("a message of {} entries is longer than MPI can send at once; use more ranks", size));
  }
  return static_cast<int>(size);
}

/// Adds its life time to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(double* seconds) : seconds_(seconds) {}
  ~Stopwatch() { *seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double* seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

MpiCommunicator::MpiCommunicator(MPI_Comm parent) {
  Check(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
  Check(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  Check(MPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
  Check(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
}

MpiCommunicator::~MpiCommunicator() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (!finalized) MPI_Comm_free(&comm_);
}

void MpiCommunicator::AllReduceMin(std::span<double> values) {
  if (size_ == 1) return;
  const Stopwatch watch(&counters_.seconds);
  ++counters_.collectives;
  Check(MPI_Allreduce(MPI_IN_PLACE, values.data(), Count(values.size()), MPI_DOUBLE, MPI_MIN, comm_), "MPI_Allreduce");
}

std::vector<double> MpiCommunicator::AllGather(std::span<const double> values) {
  if (size_ == 1) return {values.begin(), values.end()};
  const Stopwatch watch(&counters_.seconds);
  ++counters_.collectives;
  std::vector<int> counts(size_), offsets(size_);
  const int mine = Count(values.size());
  Check(MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_), "MPI_Allgather");
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  std::vector<double> all(offsets.back() + counts.back());
  Check(MPI_Allgatherv(values.data(), mine, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE, comm_),
        "MPI_Allgatherv");
  return all;
}

void MpiCommunicator::Broadcast(int root, std::vector<std::byte>* bytes) {
  const Stopwatch watch(&counters_.seconds);
  ++counters_.collectives;
  std::uint64_t size = bytes->size();
  Check(MPI_Bcast(&size, 1, MPI_UINT64_T, root, comm_), "MPI_Bcast");
  bytes->resize(size);
  Check(MPI_Bcast(bytes->data(), Count(size), MPI_BYTE, root, comm_), "MPI_Bcast");
}

// Sparse exchange by consensus: synchronous sends complete when received; a barrier that starts when one's own sends have
// completed ends when everybody's have, so nothing is then under way (Hoefler, Siebert, Lumsdaine, PPoPP 2010).
std::vector<Message> MpiCommunicator::Deliver(std::vector<Message> outgoing) {
  const Stopwatch watch(&counters_.seconds);
  const int tag = kTagDeliver + static_cast<int>(counters_.collectives % 2);
  ++counters_.collectives;
  std::vector<MPI_Request> requests(outgoing.size());
  for (std::size_t i = 0; i < outgoing.size(); ++i) {
    ++counters_.messages;
    counters_.bytes += static_cast<std::int64_t>(outgoing[i].bytes.size());
    Check(MPI_Issend(outgoing[i].bytes.data(), Count(outgoing[i].bytes.size()), MPI_BYTE, outgoing[i].rank, tag, comm_,
                     &requests[i]),
          "MPI_Issend");
  }
  std::vector<Message> incoming;
  MPI_Request barrier = MPI_REQUEST_NULL;
  bool in_barrier = false;
  for (int done = 0; !done;) {
    // Receive whatever has come, and see how far one's own sends are.
    int arrived = 0;
    MPI_Status status;
    Check(MPI_Iprobe(MPI_ANY_SOURCE, tag, comm_, &arrived, &status), "MPI_Iprobe");
    if (arrived) {
      int size = 0;
      MPI_Get_count(&status, MPI_BYTE, &size);
      Message message{status.MPI_SOURCE, std::vector<std::byte>(size)};
      Check(MPI_Recv(message.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, tag, comm_, MPI_STATUS_IGNORE), "MPI_Recv");
      incoming.push_back(std::move(message));
    }
    if (in_barrier) {
      Check(MPI_Test(&barrier, &done, MPI_STATUS_IGNORE), "MPI_Test");
    } else {
      int sent = 0;
      Check(MPI_Testall(Count(requests.size()), requests.data(), &sent, MPI_STATUSES_IGNORE), "MPI_Testall");
      if (sent) {
        Check(MPI_Ibarrier(comm_, &barrier), "MPI_Ibarrier");
        in_barrier = true;
      }
    }
  }
  std::sort(incoming.begin(), incoming.end(), [](const Message& a, const Message& b) { return a.rank < b.rank; });
  return incoming;
}

void MpiCommunicator::Exchange(std::span<const Outgoing> outgoing, std::span<const Incoming> incoming) {
  const Stopwatch watch(&counters_.seconds);
  std::vector<MPI_Request> requests;
  requests.reserve(outgoing.size() + incoming.size());
  // Receives first: a message that finds its buffer is not copied.
  for (const Incoming& from : incoming) {
    Check(MPI_Irecv(from.values.data(), Count(from.values.size()), MPI_DOUBLE, from.rank, kTagExchange, comm_,
                    &requests.emplace_back()),
          "MPI_Irecv");
  }
  for (const Outgoing& to : outgoing) {
    ++counters_.messages;
    counters_.bytes += static_cast<std::int64_t>(to.values.size_bytes());
    Check(MPI_Isend(to.values.data(), Count(to.values.size()), MPI_DOUBLE, to.rank, kTagExchange, comm_,
                    &requests.emplace_back()),
          "MPI_Isend");
  }
  Check(MPI_Waitall(Count(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
}

}  // namespace nscdd
