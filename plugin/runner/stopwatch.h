// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <ctime>

namespace nscdd {

/// [s] that have passed since any moment.
inline double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// CPU time of this process [s], all its threads: what other programs do on the machine costs cache, but is not counted as
/// such.
inline double ProcessSeconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Runs from its making on.
class Stopwatch {
 public:
  double seconds() const { return SteadySeconds() - start_; }

 private:
  double start_ = SteadySeconds();
};

}  // namespace nscdd
