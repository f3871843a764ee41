// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace nscdd {

/// A grid of nx times ny cells.
struct GridSize {
  int nx = 1;
  int ny = 1;
  std::int64_t cells() const { return std::int64_t{nx} * ny; }
};

/// "4x2": whole numbers from 1 on with an x between them; none if `text` is something else.
inline std::optional<GridSize> ParseGrid(std::string_view text) {
  GridSize grid;
  const char* end = text.data() + text.size();
  const auto [cross, no_nx] = std::from_chars(text.data(), end, grid.nx);
  if (no_nx != std::errc() || cross == end || *cross != 'x') return std::nullopt;
  const auto [last, no_ny] = std::from_chars(cross + 1, end, grid.ny);
  if (no_ny != std::errc() || last != end || grid.nx < 1 || grid.ny < 1) return std::nullopt;
  return grid;
}

}  // namespace nscdd
