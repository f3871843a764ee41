// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/vector.h"

namespace nscdd {

// The C interface sees vectors as consecutive doubles.
static_assert(sizeof(Vec2) == 2 * sizeof(double) && std::is_trivially_copyable_v<Vec2>);
static_assert(sizeof(Pose) == 3 * sizeof(double) && std::is_trivially_copyable_v<Pose>);
static_assert(sizeof(Twist) == 3 * sizeof(double) && std::is_trivially_copyable_v<Twist>);
static_assert(sizeof(Wrench) == 3 * sizeof(double) && std::is_trivially_copyable_v<Wrench>);

/// `count` as a size; rows are 32-bit integers, so more is a broken host rather than a big one. Throws Error.
inline std::size_t CheckCount(std::uint64_t count, const char* what, const std::string& who) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (count <= kMost) return static_cast<std::size_t>(count);
  throw Error(fmt::format("{}: it says {} {}, at most {} can be handled by one process", who, count, what, kMost));
}

/// Copies `count` elements of T out of an array of scalars S. Throws Error if the array is null and not empty.
template <class T, class S>
void CopyElements(const S* source, const char* name, std::size_t count, const std::string& who, std::vector<T>* target) {
  if (source == nullptr && count > 0) {
    throw Error(fmt::format("{}: the array {} is null but there are {} entries", who, name, count));
  }
  target->resize(count);
  if (count > 0) std::memcpy(static_cast<void*>(target->data()), source, count * sizeof(T));
}

template <class T>
void CopyColumn(const T* source, const char* name, std::size_t count, const std::string& who, std::vector<T>* target) {
  CopyElements(source, name, count, who, target);
}

inline void CopyPairs(const double* source, const char* name, std::size_t count, const std::string& who,
                      std::vector<Vec2>* target) {
  CopyElements(source, name, count, who, target);
}

}  // namespace nscdd
