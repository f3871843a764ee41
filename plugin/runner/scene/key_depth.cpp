// SPDX-License-Identifier: Apache-2.0
#include "scene/key_depth.h"

#include <algorithm>

namespace nscdd {
namespace {

/// Length of the string that `text` begins with, quotes included; it ends before the line's end if it is not closed on a line
/// where it has to be.
std::size_t StringLength(std::string_view text) {
  const char quote = text.front();
  const bool multiline = text.size() >= 3 && text[1] == quote && text[2] == quote;
  const std::string_view end = text.substr(0, multiline ? 3 : 1);
  for (std::size_t i = end.size(); i < text.size(); ++i) {
    if (!multiline && text[i] == '\n') return i;
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text.substr(i).starts_with(end)) {
      return i + end.size();
    }
  }
  return text.size();
}

}  // namespace

int FirstLineOfDeepKey(std::string_view text, int most) {
  int line = 1, parts = 1;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t length = 1;
    if (text[i] == '"' || text[i] == '\'') {
      length = StringLength(text.substr(i));
    } else if (text[i] == '#') {
      length = std::min(text.find('\n', i), text.size()) - i;
    } else if (text[i] == '.') {
      if (++parts > most) return line;
    } else if (std::string_view(",[]{}=\n").find(text[i]) != std::string_view::npos) {
      parts = 1;
    }
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                        text.begin() + static_cast<std::ptrdiff_t>(std::min(i + length, text.size())), '\n'));
    i += length;
  }
  return 0;
}

}  // namespace nscdd
