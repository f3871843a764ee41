// SPDX-License-Identifier: Apache-2.0
#include "option_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>

#include "nscdd/error.h"

namespace nscdd {
namespace {

template <class Number>
bool Read(std::string_view text, const Option&, Number* number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
  return error == std::errc() && end == text.data() + text.size();
}

bool Read(std::string_view text, const Option&, bool* value) {
  *value = text == "true";
  return *value || text == "false";
}

bool Read(std::string_view text, const Option& option, WordIndex* word) {
  word->index = static_cast<std::size_t>(std::find(option.words.begin(), option.words.end(), text) - option.words.begin());
  return word->index < option.words.size();
}

bool Read(std::string_view text, const Option&, GridSize* grid) {
  const std::optional<GridSize> parsed = ParseGrid(text);
  if (parsed) *grid = *parsed;
  return parsed.has_value();
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

OptionValue ParseOption(const Option& option, std::string_view text, OptionValue value) {
  const bool is_read = std::visit([&](auto& target) { return Read(text, option, &target); }, value);
  if (is_read && Allows(option, value)) return value;
  const std::string nearest = Nearest(text, option.words);
  throw Error(fmt::format("option '{}' is '{}', must be {}{}", option.name, text.substr(0, 64), MustBe(option, value),
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
