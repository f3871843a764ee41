// SPDX-License-Identifier: Apache-2.0
#include "scene/csv_number.h"

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

}  // namespace nscdd
