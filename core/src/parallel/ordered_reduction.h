// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "nscdd/communicator.h"

namespace nscdd {

/// No numbers of one kind.
struct None {};

/// One subdomain's part of a reduction: every number of `sum` is added, every number of `max` maximised (from 0). Sums and
/// Maxima are structs whose members are doubles with names.
template <class Sums, class Maxima = None>
struct ReductionPart {
  Sums sum{};
  Maxima max{};
};

/// Whether `value` takes the place of the largest one so far: a NaN does, and then stays.
inline bool Exceeds(double value, double largest) { return !(value <= largest) && !std::isnan(largest); }

namespace internal {

template <class Numbers>
constexpr std::size_t kCount = std::is_empty_v<Numbers> ? 0 : sizeof(Numbers) / sizeof(double);

/// The members of a struct of doubles, in their order.
template <class Numbers>
std::array<double, kCount<Numbers>> Flatten(const Numbers& numbers) {
  if constexpr (std::is_empty_v<Numbers>) {
    return {};
  } else {
    static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) % sizeof(double) == 0);
    return std::bit_cast<std::array<double, kCount<Numbers>>>(numbers);
  }
}

template <class Numbers>
void Unflatten(const double* from, Numbers* numbers) {
  if constexpr (!std::is_empty_v<Numbers>) {
    std::array<double, kCount<Numbers>> all;
    std::copy_n(from, all.size(), all.begin());
    *numbers = std::bit_cast<Numbers>(all);
  }
}

}  // namespace internal

/// Reduces the parts of all subdomains. `parts` are those of this rank's subdomains in ascending order, and ranks hold
/// ascending blocks of subdomains: numbers are therefore added in the order of the subdomains, whatever the number of ranks. A
/// NaN anywhere makes the result NaN, in maxima too. Collective, one call.
template <class Sums, class Maxima>
ReductionPart<Sums, Maxima> ReduceInOrder(const std::vector<ReductionPart<Sums, Maxima>>& parts, Communicator* communicator) {
  constexpr std::size_t kSums = internal::kCount<Sums>, kSize = kSums + internal::kCount<Maxima>;
  std::vector<double> mine;
  mine.reserve(kSize * parts.size());
  for (const auto& part : parts) {
    for (const double number : internal::Flatten(part.sum)) mine.push_back(number);
    for (const double number : internal::Flatten(part.max)) mine.push_back(number);
  }
  std::vector<double> others;
  if (communicator->size() > 1) others = communicator->AllGather(mine);
  const std::vector<double>& all = communicator->size() > 1 ? others : mine;
  // Ranks hold ascending blocks: what AllGather() returns is in the order of the subdomains.
  std::array<double, kSize> total{};
  for (std::size_t i = 0; i < all.size(); i += kSize) {
    for (std::size_t k = 0; k < kSums; ++k) total[k] += all[i + k];
    for (std::size_t k = kSums; k < kSize; ++k) {
      if (Exceeds(all[i + k], total[k])) total[k] = all[i + k];
    }
  }
  ReductionPart<Sums, Maxima> result;
  internal::Unflatten(total.data(), &result.sum);
  internal::Unflatten(total.data() + kSums, &result.max);
  return result;
}

/// Minima and maxima over all ranks, in place; exact, so the same on any number of ranks. Both are structs of named
/// doubles. Collective, one call.
template <class Minima, class Maxima>
void ReduceExtremes(Minima* minima, Maxima* maxima, Communicator* communicator) {
  constexpr std::size_t kMinima = internal::kCount<Minima>;
  std::array<double, kMinima + internal::kCount<Maxima>> all;
  std::ranges::copy(internal::Flatten(*minima), all.begin());
  std::ranges::transform(internal::Flatten(*maxima), all.begin() + kMinima, [](double x) { return -x; });
  communicator->AllReduceMin(all);
  internal::Unflatten(all.data(), minima);
  std::transform(all.begin() + kMinima, all.end(), all.begin() + kMinima, [](double x) { return -x; });
  internal::Unflatten(all.data() + kMinima, maxima);
}

}  // namespace nscdd
