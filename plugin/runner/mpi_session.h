// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "results/rank_group.h"

namespace nscdd {

/// MPI for the life of the program, if a launcher (mpirun, srun) started it; without one MPI is not touched at all.
class MpiSession {
 public:
  MpiSession(int* argc, char*** argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// For results and messages of the runner.
  const RankGroup& ranks() const { return ranks_; }
  /// Fortran handle for the solver; none without MPI.
  std::optional<std::int32_t> solver_communicator() const { return solver_; }
  /// Ends all ranks at once: for what no other rank knows of.
  [[noreturn]] void Abort(int code) const;

 private:
  bool on_ = false;
  RankGroup ranks_;
  std::optional<std::int32_t> solver_;
};

}  // namespace nscdd
