// SPDX-License-Identifier: Apache-2.0
#include "scene/toml_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "nscdd/error.h"
#include "scene/text.h"

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

namespace {

constexpr int kDeepestKey = 16;
constexpr std::uintmax_t kLargestFile = 64u << 20;  // [bytes]; more disks than that belong in a CSV file

}  // namespace

std::string ReadTomlText(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    const char* what = std::filesystem::exists(path, error) ? "is a folder or a device, not a file" : "there is no such file";
    throw Error(fmt::format("{}: {}; check the name.", path.string(), what));
  }
  if (std::filesystem::file_size(path, error) > kLargestFile) {
    throw Error(
        fmt::format("{}: is larger than 64 MB; put the disks into a CSV file ([[disks]] file = \"...\").", path.string()));
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream || text.str().empty()) {
    throw Error(fmt::format("{}: is empty or cannot be read; write a scene (see sample_scenes/README.md).", path.string()));
  }
  return text.str();
}

toml::table ParseTomlFile(const std::filesystem::path& path) { return ParseToml(ReadTomlText(path), path); }

toml::table ParseToml(const std::string& text, const std::filesystem::path& path) {
  if (const int line = FirstLineOutsideUtf8(text); line > 0) {
    throw Error(fmt::format("{}:{}: is not UTF-8 text; save the file in this encoding.", path.string(), line));
  }
  // toml++ limits the nesting of values, not that of keys.
  if (const int line = FirstLineOfDeepKey(text, kDeepestKey); line > 0) {
    throw Error(fmt::format("{}:{}: has a key of more than {} parts; scenes need two.", path.string(), line, kDeepestKey));
  }
  try {
    return toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    throw Error(Sentence(fmt::format("{}:{}: is not valid TOML ({}); mend this line", path.string(), error.source().begin.line,
                                     error.description())));
  }
}

std::string OptionText(const TableReader& table, std::string_view key, const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* number = node.as_floating_point()) {
    if (!std::isfinite(number->get())) table.Refuse(key, fmt::format("is {}; give a finite number", number->get()));
    return fmt::format("{}", number->get());
  }
  const toml::array* pair = node.as_array();
  if (pair != nullptr && pair->size() == 2 && pair->get(0)->is_integer() && pair->get(1)->is_integer()) {
    return fmt::format("{}x{}", pair->get(0)->as_integer()->get(), pair->get(1)->as_integer()->get());
  }
  table.Refuse(key, fmt::format("is {}; give a number, a text, true or false, or a pair of integers", TypeName(node)));
}

}  // namespace nscdd
