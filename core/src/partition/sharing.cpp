#include "partition/sharing.h"

#include <algorithm>
#include <utility>

namespace nscdd {

Sharing MakeSharing(std::size_t rows, std::vector<std::pair<std::int32_t, std::int32_t>> pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Sharing sharing;
  sharing.begin.assign(rows + 1, 0);
  sharing.subdomain.reserve(pairs.size());
  for (const auto& [row, subdomain] : pairs) {
    ++sharing.begin[row + 1];
    sharing.subdomain.push_back(subdomain);
  }
  for (std::size_t row = 0; row < rows; ++row) sharing.begin[row + 1] += sharing.begin[row];
  return sharing;
}

}  // namespace nscdd
