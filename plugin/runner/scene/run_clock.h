// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace nscdd {

/// Where a run is, or several that follow each other.
struct RunClock {
  std::int64_t step = 0;        ///< steps done
  double time = 0.0;            ///< [s] sum of their time steps
  std::int64_t even_since = 0;  ///< all steps behind this one have had the same length; it ended at `even_time`
  double even_time = 0.0;       ///< [s]

  /// [s] when step `k` > even_since ends, if steps go on with length `dt`; a product, so that rounding does not add up.
  double TimeOf(std::int64_t k, double dt) const { return even_time + static_cast<double>(k - even_since) * dt; }
};

}  // namespace nscdd
