// SPDX-License-Identifier: Apache-2.0
#include "option_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "nscdd/error.h"
#include "text/nearest_name.h"

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

}  // namespace

OptionValue ParseOption(const Option& option, std::string_view text, OptionValue value) {
  const bool is_read = std::visit([&](auto& target) { return Read(text, option, &target); }, value);
  if (is_read && Allows(option, value)) return value;
  const std::string nearest = NearestName(text, option.words);
  throw Error(fmt::format("option '{}' is '{}', must be {}{}", option.name, text.substr(0, 64), MustBe(option, value),
                          nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest)));
}

}  // namespace nscdd
