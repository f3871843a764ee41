// SPDX-License-Identifier: Apache-2.0
#include "scene/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

namespace nscdd {
namespace {

/// Length of the valid sequence that `text` begins with; 0 if there is none.
std::size_t SequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  // Overlong forms, surrogates, and beyond U+10FFFF.
  if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F)) return 0;
  if ((first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F)) return 0;
  return length;
}

}  // namespace

int FirstLineOutsideUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = SequenceLength(text.substr(i));
    if (length == 0) return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n'));
    i += length;
  }
  return 0;
}

bool HasControls(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

std::string Printable(std::string_view text) {
  constexpr std::size_t kLongest = 1000, kEnd = 300;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text.size() > kLongest && result.size() >= kLongest - kEnd && i + kEnd < text.size()) {
      result += " [...] ";
      i = text.size() - kEnd;
    }
    const std::size_t length = SequenceLength(text.substr(i));
    const std::string_view character = text.substr(i, std::max<std::size_t>(length, 1));
    result += length == 0 || HasControls(character) ? std::string_view("?") : character;
    i += character.size();
  }
  return result;
}

std::string Sentence(std::string text) {
  if (!text.ends_with('?')) text += '.';
  return Printable(text);
}

std::string Suggestion(std::string_view word, std::span<const std::string> known, std::string_view noun) {
  const std::string nearest = NearestName(word, known);
  if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
  return fmt::format("{} are {}", noun, fmt::join(known, ", "));
}

}  // namespace nscdd
