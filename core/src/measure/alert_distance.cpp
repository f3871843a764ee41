// SPDX-License-Identifier: Apache-2.0
#include "nscdd/step_problem.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nscdd {

double DefaultAlertDistance(const BodyTable& bodies, Communicator* communicator) {
  const auto is_free = [&](std::size_t i) { return bodies.kind[i] == BodyKind::kFree; };
  double largest = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (is_free(i)) largest = std::min(largest, -bodies.radius[i]);
  }
  communicator->AllReduceMin({&largest, 1});
  largest = -largest;
  double mine[2] = {0.0, 0.0};
  const double unit = std::ldexp(1.0, 26);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!is_free(i)) continue;
    mine[0] += largest > 0.0 ? std::round(bodies.radius[i] / largest * unit) : 0.0;
    mine[1] += 1.0;
  }
  const std::vector<double> all = communicator->AllGather(mine);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < all.size(); i += 2) {
    sum += all[i];
    count += all[i + 1];
  }
  return count > 0.0 ? 0.1 * largest * (sum / unit / count) : -1.0;
}

}  // namespace nscdd
