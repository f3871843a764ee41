// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nscdd/callback/callback_adapter.h"
#include "nscdd/communicator.h"
#include "nscdd/report.h"
#include "nscdd/time_stepper.h"
#include "nscdd_plugin.h"
#include "result_table.h"
#include "solver_infos.h"

namespace nscdd {

/// Behind one nscdd_solver: a time stepper over the host, or single problems only when there is no host.
class SolverHandle {
 public:
  /// Collective over the communicator in `arguments`; throws the same Error on all its ranks.
  explicit SolverHandle(const nscdd_create_arguments& arguments);

  void Step(double dt);
  void Solve(const nscdd_problem& problem, nscdd_solution* solution);
  void Report(nscdd_report* report) const;
  void Table(std::string_view name, nscdd_table* table);
  std::vector<std::byte> SaveState() const;
  void LoadState(const void* bytes, std::uint64_t size);
  void LoadStates(std::uint64_t count, const void* const* parts, const std::uint64_t* sizes);

 private:
  TimeStepper& stepper(const char* function) const;

  SolverSettings settings_;
  std::unique_ptr<Communicator> communicator_;
  std::unique_ptr<CallbackAdapter> adapter_;
  std::unique_ptr<TimeStepper> stepper_;  // null without a host
  StepReport report_;
  enum class Last { kNothing, kStep, kSolve } last_ = Last::kNothing;
  ResultTable table_;
};

}  // namespace nscdd
