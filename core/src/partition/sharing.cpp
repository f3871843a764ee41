// SPDX-License-Identifier: Apache-2.0
#include "partition/sharing.h"

#include <algorithm>
#include <utility>

namespace nscdd {

Sharing MakeSharing(std::size_t rows, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  Sharing sharing;
  sharing.begin.assign(rows + 1, 0);
  for (const auto& [row, subdomain] : pairs) ++sharing.begin[row + 1];
  for (std::size_t row = 0; row < rows; ++row) sharing.begin[row + 1] += sharing.begin[row];
  sharing.subdomain.resize(pairs.size());
  std::vector<std::int32_t> next(sharing.begin.begin(), sharing.begin.end() - 1);
  for (const auto& [row, subdomain] : pairs) sharing.subdomain[next[row]++] = subdomain;
  // A few per row: sort them, drop those that are there twice, close the gaps.
  auto out = sharing.subdomain.begin();
  for (std::size_t row = 0; row < rows; ++row) {
    const auto first = sharing.subdomain.begin() + sharing.begin[row], last = sharing.subdomain.begin() + next[row];
    sharing.begin[row] = static_cast<std::int32_t>(out - sharing.subdomain.begin());
    std::sort(first, last);
    const auto end = std::unique(first, last);
    for (auto e = first; e != end; ++e) *out++ = *e;
  }
  sharing.begin[rows] = static_cast<std::int32_t>(out - sharing.subdomain.begin());
  sharing.subdomain.erase(out, sharing.subdomain.end());
  return sharing;
}

}  // namespace nscdd
