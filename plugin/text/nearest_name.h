// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cctype>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nscdd {

/// Insertions, deletions and replacements (Levenshtein) that turn `a` into `b`; case does not count.
inline std::size_t Corrections(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// The name of `known` that needs the fewest typing corrections to become `word`; empty if none is near.
inline std::string NearestName(std::string_view word, std::span<const std::string> known) {
  if (word.size() > 100) return {};  // hostile text must not cost time
  std::string best;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& name : known) {
    const std::size_t corrections = Corrections(word, name);
    if (corrections < fewest && corrections < name.size()) {
      fewest = corrections;
      best = name;
    }
  }
  return best;
}

}  // namespace nscdd
