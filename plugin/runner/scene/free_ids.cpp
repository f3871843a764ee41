// SPDX-License-Identifier: Apache-2.0
#include "scene/free_ids.h"

#include <algorithm>
#include <iterator>

namespace nscdd {

FreeIds::FreeIds(const std::vector<std::int64_t>& taken, std::int64_t needed) {
  gaps_.clear();
  Gap gap;
  for (const std::int64_t id : taken) {
    if (gap.number + (id - gap.id) >= needed) break;
    if (id > gap.id) gaps_.push_back(gap);
    gap = {id + 1, gap.number + (id - gap.id)};
  }
  gaps_.push_back(gap);
}

std::int64_t FreeIds::At(std::int64_t k) const {
  const auto behind =
      std::upper_bound(gaps_.begin(), gaps_.end(), k, [](std::int64_t n, const Gap& gap) { return n < gap.number; });
  const Gap& gap = *std::prev(behind);
  return gap.id + (k - gap.number);
}

std::optional<std::int64_t> FreeIds::NumberOf(std::int64_t id) const {
  const auto behind =
      std::upper_bound(gaps_.begin(), gaps_.end(), id, [](std::int64_t n, const Gap& gap) { return n < gap.id; });
  if (behind == gaps_.begin()) return std::nullopt;
  const Gap& gap = *std::prev(behind);
  const std::int64_t number = gap.number + (id - gap.id);
  if (behind != gaps_.end() && number >= behind->number) return std::nullopt;
  return number;
}

}  // namespace nscdd
