// SPDX-License-Identifier: Apache-2.0
#include "auto/front_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>

#include "nscdd/error.h"
#include "nscdd/grid_size.h"

namespace nscdd {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else if (c != '\r') {
      parts.back() += c;
    }
  }
  return parts;
}

/// A line of the file by the names of the header.
class Line {
 public:
  Line(const std::filesystem::path& file, int number, const std::vector<std::string>& header, const std::string& text)
      : where_(fmt::format("{}:{}", file.string(), number)), header_(header), cells_(Split(text, ',')) {}

  const std::string& Text(const std::string& column) const {
    const auto at = std::find(header_.begin(), header_.end(), column) - header_.begin();
    if (static_cast<std::size_t>(at) < std::min(header_.size(), cells_.size())) return cells_[static_cast<std::size_t>(at)];
    throw Error(fmt::format("{}: has no column '{}'; measure the front anew with `nscdd tradeoff --store`, or remove the file",
                            where_, column));
  }

  double Number(const std::string& column) const {
    const std::string& text = Text(column);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value) && value >= 0.0) return value;
    throw Error(fmt::format("{}: column '{}' is '{}', no number >= 0; measure the front anew with `nscdd tradeoff --store`",
                            where_, column, text));
  }

  void CheckGrid(const std::string& grid) const {
    if (ParseGrid(grid)) return;
    throw Error(fmt::format("{}: subdomains = {} is no grid such as 4x2; measure the front anew with `nscdd tradeoff --store`",
                            where_, grid));
  }

 private:
  std::string where_;
  const std::vector<std::string>& header_;
  std::vector<std::string> cells_;
};

FrontEntry EntryOf(const Line& line) {
  FrontEntry entry;
  entry.setting.name = line.Text("setting");
  entry.setting.solver = line.Text("solver");
  for (const std::string& option : Split(line.Text("options"), ';')) {
    const auto equals = option.find('=');
    if (equals != std::string::npos) entry.setting.options.emplace_back(option.substr(0, equals), option.substr(equals + 1));
  }
  line.CheckGrid(entry.setting.Option("subdomains", "1x1"));
  entry.seconds = line.Number("seconds");
  entry.nat = line.Number("nat");
  entry.interpenetration = line.Number("interpenetration_max");
  return entry;
}

}  // namespace

std::filesystem::path FrontFileOf(const std::filesystem::path& scene) {
  std::filesystem::path file = scene;
  return file.replace_extension(".front.csv");
}

std::vector<FrontEntry> ReadFront(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string text;
  if (!stream || !std::getline(stream, text)) {
    throw Error(
        fmt::format("{}: cannot be read or is empty; measure the front anew with `nscdd tradeoff --store`", file.string()));
  }
  const std::vector<std::string> header = Split(text, ',');
  std::vector<FrontEntry> entries;
  for (int number = 2; std::getline(stream, text); ++number) {
    if (!text.empty()) entries.push_back(EntryOf(Line(file, number, header, text)));
  }
  return entries;
}

}  // namespace nscdd
