// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>

#include "nscdd/mpi_communicator.h"

namespace nscdd::test {

/// A case that all ranks run together; `communicator` is a duplicate of MPI_COMM_WORLD.
class MpiTest : public testing::Test {
 protected:
  MpiCommunicator communicator{MPI_COMM_WORLD};
};

template <class Parameter>
class MpiTestWithParam : public MpiTest, public testing::WithParamInterface<Parameter> {};

/// EXPECT_TRUE(Says(sentence, part)): `part` occurs in the sentence.
inline testing::AssertionResult Says(const std::string& sentence, const std::string& part) {
  if (sentence.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in '" << sentence << "'";
}

}  // namespace nscdd::test
