// SPDX-License-Identifier: Apache-2.0
// main() of GoogleTest cases that all ranks of MPI_COMM_WORLD run together. NSCDD_TEST_RANKS: on how many, "1,2,4".
// A case is collective: an ASSERT that leaves it on one rank only lets the others wait until ctest's time-out.

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// At the end of a case that failed anywhere, fails it on the ranks where it did not. Ranks other than 0 print nothing but
/// their failures.
class Agreement final : public testing::EmptyTestEventListener {
 public:
  Agreement(int rank, int size) : rank_(rank), size_(size) {}

 private:
  void OnTestPartResult(const testing::TestPartResult& part) override {
    if (rank_ == 0 || !part.failed() || agreeing_) return;
    std::printf("rank %d: %s:%d: %s\n", rank_, part.file_name() != nullptr ? part.file_name() : "?", part.line_number(),
                part.message());
    std::fflush(stdout);
  }

  void OnTestEnd(const testing::TestInfo& test) override {
    const int mine = test.result()->Failed() ? 1 : 0;
    std::vector<int> failed(static_cast<std::size_t>(size_));
    MPI_Allgather(&mine, 1, MPI_INT, failed.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::string ranks;
    for (int rank = 0; rank < size_; ++rank) {
      if (failed[static_cast<std::size_t>(rank)] != 0) ranks += (ranks.empty() ? "" : ", ") + std::to_string(rank);
    }
    if (mine != 0 || ranks.empty()) return;
    agreeing_ = true;
    ADD_FAILURE() << test.test_suite_name() << "." << test.name() << " failed on rank " << ranks << "; so it fails on all.";
    agreeing_ = false;
  }

  int rank_, size_;
  bool agreeing_ = false;
};

bool IsForRanks(int size) {
  std::istringstream ranks(NSCDD_TEST_RANKS);
  for (std::string one; std::getline(ranks, one, ',');) {
    if (std::stoi(one) == size) return true;
  }
  return false;
}

int RunAllTests(int rank, int size) {
  if (!IsForRanks(size)) {
    if (rank == 0) std::fprintf(stderr, "These tests are for %s ranks, not for %d: mpirun -n ...\n", NSCDD_TEST_RANKS, size);
    return 2;
  }
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  if (rank != 0) {
    delete listeners.Release(listeners.default_result_printer());
    delete listeners.Release(listeners.default_xml_generator());
  }
  listeners.Append(new Agreement(rank, size));  // owned by GoogleTest; ends of cases are told to the last listener first
  return RUN_ALL_TESTS();
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  MPI_Init(&argc, &argv);
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const int status = RunAllTests(rank, size);
  MPI_Finalize();
  return status;
}
