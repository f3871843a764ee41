// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "nscdd/communicator.h"

namespace nscdd {

/// One subdomain's part of a reduction: the first kSums numbers are added, the others maximised.
template <std::size_t kSums, std::size_t kMaxima>
using ReductionPart = std::array<double, kSums + kMaxima>;

/// Whether `value` takes the place of the largest one so far: a NaN does, and then stays.
inline bool Exceeds(double value, double largest) { return !(value <= largest) && !std::isnan(largest); }

/// Reduces the parts of all subdomains. `parts` are those of this rank's subdomains in ascending order, and ranks hold
/// ascending blocks of subdomains: numbers are therefore added in the order of the subdomains, whatever the number of ranks. A
/// NaN anywhere makes the result NaN, in maxima too. Collective, one call.
template <std::size_t kSums, std::size_t kMaxima>
ReductionPart<kSums, kMaxima> ReduceInOrder(const std::vector<ReductionPart<kSums, kMaxima>>& parts,
                                            Communicator* communicator) {
  constexpr std::size_t kSize = kSums + kMaxima;
  ReductionPart<kSums, kMaxima> total{};
  const auto add = [&total](const double* part) {
    for (std::size_t k = 0; k < kSums; ++k) total[k] += part[k];
    for (std::size_t k = kSums; k < kSize; ++k) {
      if (Exceeds(part[k], total[k])) total[k] = part[k];
    }
  };
  if (communicator->size() == 1) {
    for (const auto& part : parts) add(part.data());
    return total;
  }
  std::vector<double> mine;
  for (const auto& part : parts) {
    for (const double number : part) mine.push_back(number);
  }
  const std::vector<double> all = communicator->AllGather(mine);
  for (std::size_t i = 0; i < all.size(); i += kSize) add(&all[i]);
  return total;
}

}  // namespace nscdd
