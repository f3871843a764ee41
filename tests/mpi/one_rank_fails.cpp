// SPDX-License-Identifier: Apache-2.0
// The faulty subject of mpi_main.cpp: started on three ranks, it fails on rank 1 only.

#include <gtest/gtest.h>
#include <mpi.h>

TEST(OneRank, Fails) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  EXPECT_NE(rank, 1);
}
