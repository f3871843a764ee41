// SPDX-License-Identifier: Apache-2.0
#include "algorithms/squeezed_bodies.h"

#include <algorithm>
#include <bit>

#include "nlgs/residual.h"
#include "parallel/ordered_reduction.h"

namespace nscdd {
namespace {

constexpr double kShare = 1e-3;
constexpr std::size_t kAtMost = 64;

struct Largest {
  double power;
};

}  // namespace

std::vector<std::int64_t> SqueezedBodies(const PartitionedProblem& problem, const PartitionedState& state,
                                         Communicator* communicator) {
  std::vector<std::vector<double>> powers;
  std::vector<ReductionPart<None, Largest>> parts(problem.subdomains.size());
  for (std::size_t e = 0; e < parts.size(); ++e) {
    powers.push_back(ViolatedPowers(problem.subdomains[e], state.subdomains[e]));
    for (const double power : powers[e]) parts[e].max.power = std::max(parts[e].max.power, power);
  }
  const double least = kShare * ReduceInOrder(parts, communicator).max.power;
  std::vector<double> mine;
  for (std::size_t e = 0; e < powers.size(); ++e) {
    for (std::size_t k = 0; k < powers[e].size(); ++k) {
      if (!(powers[e][k] >= least)) continue;
      const auto c = static_cast<std::size_t>(problem.subdomains[e].contact[k]);
      for (const std::int32_t row : {problem.contacts->a[c], problem.contacts->b[c]}) {
        mine.push_back(std::bit_cast<double>((*problem.body_id)[row]));  // any number fits
      }
    }
  }
  std::vector<std::int64_t> ids;
  for (const double bits : communicator->AllGather(mine)) ids.push_back(std::bit_cast<std::int64_t>(bits));
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (ids.size() > kAtMost) ids.resize(kAtMost);
  return ids;
}

}  // namespace nscdd
