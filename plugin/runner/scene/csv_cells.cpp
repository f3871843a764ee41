// SPDX-License-Identifier: Apache-2.0
#include "scene/csv_cells.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace nscdd {
namespace {

constexpr double kLargestWholeId = 9007199254740992.0;  // 2^53

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

template <typename T>
std::from_chars_result Parse(std::string_view text, T* value) {
  return std::from_chars(text.data(), text.data() + text.size(), *value);
}

template <typename T>
std::optional<T> ParseWhole(std::string_view text) {
  T value{};
  const auto [end, error] = Parse(text, &value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// As std::from_chars reads it: without plus sign, with point and e. Empty if a comma is not between digits.
std::string PlainText(std::string_view text) {
  if (text.starts_with('+') && text.size() > 1 && (IsDigit(text[1]) || text[1] == '.')) text.remove_prefix(1);
  std::string plain(text);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (plain[i] == 'd' || plain[i] == 'D') plain[i] = 'e';
    if (plain[i] != ',') continue;
    if (i == 0 || i + 1 == plain.size() || !IsDigit(plain[i - 1]) || !IsDigit(plain[i + 1])) return {};
    plain[i] = '.';
  }
  return plain;
}

/// Is the number below 1? `plain` is one that no double holds, far from 1 therefore.
bool IsTiny(std::string_view plain) {
  const auto e = std::min(plain.find_first_of("eE"), plain.size());
  const std::string_view digits = plain.substr(0, e);
  const auto first = static_cast<std::int64_t>(digits.find_first_of("123456789"));
  const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
  std::string_view exponent_text = plain.substr(std::min(e + 1, plain.size()));
  if (exponent_text.starts_with('+')) exponent_text.remove_prefix(1);
  if (exponent_text.empty()) return first > point;
  std::int64_t exponent = 0;
  if (Parse(exponent_text, &exponent).ec != std::errc{}) return exponent_text.front() == '-';
  return exponent < first - point;
}

}  // namespace

std::optional<double> CsvNumber(std::string_view text) {
  if (std::none_of(text.begin(), text.end(), IsDigit)) return std::nullopt;  // "nan", "inf"
  const std::string plain = PlainText(text);
  double value = 0.0;
  const auto [end, error] = Parse(plain, &value);
  if (plain.empty() || end != plain.data() + plain.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range && IsTiny(plain)) return plain.front() == '-' ? -0.0 : 0.0;
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> CsvId(std::string_view text) {
  std::optional<std::int64_t> id = ParseWhole<std::int64_t>(text);
  if (!id) {
    const std::optional<double> number = CsvNumber(text);
    if (!number || *number != std::floor(*number) || std::abs(*number) > kLargestWholeId) return std::nullopt;
    id = static_cast<std::int64_t>(*number);
  }
  if (*id < 0) return std::nullopt;
  return id;
}

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
