// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

namespace nscdd {

/// CPU time of this process [s], all its threads: what other programs do on the machine costs cache, but is not counted as
/// such.
inline double ProcessSeconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace nscdd
