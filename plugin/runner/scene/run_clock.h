// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace nscdd {

/// Where a run is, or several that follow each other.
struct RunClock {
  std::int64_t step = 0;        ///< steps done
  double time = 0.0;            ///< [s] sum of their time steps
  std::int64_t even_since = 0;  ///< all steps behind this one have had the same length; it ended at `even_time`
  double even_time = 0.0;       ///< [s] hence step k begins at even_time + (k - 1 - even_since) dt
};

}  // namespace nscdd
