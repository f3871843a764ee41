// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace nscdd {

/// The integers >= 0 that no body has as an id of its own, counted upwards: bodies without an id take them in the order of the
/// scene. Holds no more than one entry per gap between the ids that are taken.
class FreeIds {
 public:
  FreeIds() = default;  ///< all are free
  /// `taken` ascends; only the first `needed` free ids will be asked for.
  FreeIds(const std::vector<std::int64_t>& taken, std::int64_t needed);

  /// The free id number `k`, from 0.
  std::int64_t At(std::int64_t k) const;
  /// The k of a free id; nothing if the id is taken. Ids behind the last one needed pass for free.
  std::optional<std::int64_t> NumberOf(std::int64_t id) const;

 private:
  struct Gap {
    std::int64_t id = 0;      ///< the first one free
    std::int64_t number = 0;  ///< of free ids before it
  };
  std::vector<Gap> gaps_{Gap{}};
};

}  // namespace nscdd
