// SPDX-License-Identifier: Apache-2.0
#include "algorithms/algorithms.h"

#include <variant>

#include "algorithms/monitor.h"

namespace nscdd {

SolveReport SolveAny(const PartitionedProblem& problem, const AlgorithmOptions& options, Communicator* communicator,
                     InterfaceWorkspace* workspace, PartitionedState* state) {
  if (problem.contact_count == 0) return ReportWithoutContacts(problem);
  return std::visit([&](const auto& o) { return Solve(problem, o, communicator, workspace, state); }, options);
}

}  // namespace nscdd
