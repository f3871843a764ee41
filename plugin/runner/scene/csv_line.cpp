// SPDX-License-Identifier: Apache-2.0
#include "scene/csv_line.h"

#include <algorithm>

#include "scene/csv_number.h"

namespace nscdd {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool IsSeparator(char c, Separator separator) {
  if (separator == Separator::kBlank) return c == ' ' || c == '\t';
  return c == (separator == Separator::kComma ? ',' : ';');
}

/// Position of the first separator outside quotes; the line's length if there is none, npos if a quote is not closed.
std::size_t FieldEnd(std::string_view line, Separator separator) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (!quoted && IsSeparator(line[i], separator)) return i;
  }
  return quoted ? std::string_view::npos : line.size();
}

bool Has(std::string_view line, Separator separator) { return FieldEnd(line, separator) < line.size(); }

std::string_view Unquote(std::string_view field) {
  const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return is_quoted ? Trim(field.substr(1, field.size() - 2)) : field;
}

}  // namespace

std::string_view Trim(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

Separator FindSeparator(std::string_view line) {
  if (Has(line, Separator::kSemicolon)) return Separator::kSemicolon;
  if (!Has(line, Separator::kComma)) return Separator::kBlank;
  std::vector<std::string_view> words;
  const bool numbers =
      SplitLine(line, Separator::kBlank, &words) &&
      std::all_of(words.begin(), words.end(), [](std::string_view word) { return CsvNumber(word).has_value(); });
  return numbers ? Separator::kBlank : Separator::kComma;
}

bool SplitLine(std::string_view line, Separator separator, std::vector<std::string_view>* fields) {
  fields->clear();
  line = Trim(line);
  for (;;) {
    const std::size_t end = FieldEnd(line, separator);
    if (end == std::string_view::npos) return false;
    fields->push_back(Unquote(Trim(line.substr(0, end))));
    if (end == line.size()) return true;
    line.remove_prefix(end + 1);
    if (separator == Separator::kBlank) line = Trim(line);
  }
}

}  // namespace nscdd
