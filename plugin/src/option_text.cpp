// SPDX-License-Identifier: Apache-2.0
#include "option_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "nscdd/error.h"

namespace nscdd {
namespace {

constexpr int kMostCellsPerSide = 100000;
constexpr long kMostCells = 10'000'000;

[[noreturn]] void Refuse(std::string_view option, std::string_view text, const std::string& must_be) {
  throw Error(fmt::format("option '{}' is '{}', must be {}", option, text.substr(0, 64), must_be));
}

template <class Number>
bool ParseWhole(std::string_view text, Number* number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
  return error == std::errc() && end == text.data() + text.size();
}

std::string Describe(const char* kind, const Range& range) {
  const bool below = range.least > -1e308, above = range.most < 1e308;
  std::string text = kind;
  if (below) text += fmt::format(" {} {}", range.least_excluded ? ">" : ">=", range.least);
  if (above) text += fmt::format("{} <= {}", below ? " and" : "", range.most);
  return text;
}

bool Inside(double value, const Range& range) {
  return (range.least_excluded ? value > range.least : value >= range.least) && value <= range.most;
}

// Levenshtein's distance, one row at a time.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

double ParseReal(std::string_view option, std::string_view text, const Range& range) {
  double value = 0.0;
  if (!ParseWhole(text, &value) || !std::isfinite(value) || !Inside(value, range)) {
    Refuse(option, text, Describe("a finite number", range));
  }
  return value;
}

int ParseInteger(std::string_view option, std::string_view text, const Range& range) {
  int value = 0;
  if (!ParseWhole(text, &value) || !Inside(value, range)) Refuse(option, text, Describe("a whole number", range));
  return value;
}

bool ParseBool(std::string_view option, std::string_view text) {
  if (text == "true") return true;
  if (text == "false") return false;
  Refuse(option, text, "true or false");
}

void ParseGrid(std::string_view option, std::string_view text, PartitionOptions* grid) {
  const std::size_t cross = text.find('x');
  int nx = 0, ny = 0;
  const bool two =
      cross != std::string_view::npos && ParseWhole(text.substr(0, cross), &nx) && ParseWhole(text.substr(cross + 1), &ny);
  if (!two || nx < 1 || ny < 1 || nx > kMostCellsPerSide || ny > kMostCellsPerSide || static_cast<long>(nx) * ny > kMostCells) {
    Refuse(option, text,
           fmt::format("a grid such as 4x2 with 1 to {} cells per side and at most {} in all", kMostCellsPerSide, kMostCells));
  }
  grid->nx = nx;
  grid->ny = ny;
}

std::size_t ParseChoice(std::string_view option, std::string_view text, const std::vector<std::string>& choices) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  const std::string nearest = Nearest(text, choices);
  Refuse(option, text,
         fmt::format("one of {}{}", fmt::join(choices, ", "),
                     nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest)));
}

std::string Nearest(std::string_view text, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 64;  // hostile text must not cost time
  text = text.substr(0, kLongest);
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, text.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = EditDistance(text, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace nscdd
