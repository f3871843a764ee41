// SPDX-License-Identifier: Apache-2.0
#include "scene/disk_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "nscdd/error.h"
#include "scene/names.h"
#include "scene/utf8.h"

namespace nscdd {
namespace {

enum Column : std::size_t { kId, kX, kY, kRadius, kAngle, kVx, kVy, kSpin, kMaterial };

const std::vector<std::string>& ColumnNames() {
  static const std::vector<std::string> names = {"id", "x", "y", "radius", "angle", "vx", "vy", "spin", "material"};
  return names;
}

std::string_view Trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> Split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.push_back(Trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <typename T>
std::optional<T> Parse(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double* Target(std::size_t column, DiskRow* row) {
  switch (column) {
    case kX:
      return &row->pose.x;
    case kY:
      return &row->pose.y;
    case kRadius:
      return &row->radius;
    case kAngle:
      return &row->pose.angle;
    case kVx:
      return &row->velocity.vx;
    case kVy:
      return &row->velocity.vy;
    default:
      return &row->velocity.spin;
  }
}

}  // namespace

DiskFileReader::DiskFileReader(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) stream_.open(path);
  if (!stream_.is_open())
    throw Error(fmt::format("{}: cannot be read; check that this CSV file is there and readable.", path.string()));
  ReadHeader();
}

void DiskFileReader::Refuse(const std::string& what) const {
  throw Error(Sentence(fmt::format("{}:{}: {}", path_.string(), std::max<std::int64_t>(line_number_, 1), what)));
}

void DiskFileReader::CheckText(std::string_view line) const {
  if (FirstLineOutsideUtf8(line) > 0) Refuse("is not UTF-8 text; save the file in this encoding");
  const auto is_control = [](char c) { return c != '\t' && c != '\r' && HasControls({&c, 1}); };
  if (std::any_of(line.begin(), line.end(), is_control)) Refuse("has a control character in it; give text");
}

bool DiskFileReader::NextLine() {
  while (!stream_.eof()) {
    ++line_number_;
    // Sets failbit when the line fills the array, and with eofbit when there is no further line.
    stream_.getline(line_.data(), line_.size());
    if (stream_.bad()) Refuse("reading failed here; check the disk");
    if (stream_.fail() && !stream_.eof())
      Refuse(fmt::format("the line is longer than {} characters; give one disk per line", line_.size() - 2));
    // A zero byte would hide the rest of its line.
    const auto read = static_cast<std::size_t>(stream_.gcount()) - (stream_.eof() || stream_.gcount() == 0 ? 0 : 1);
    CheckText({line_.data(), read});
    const std::string_view text = Trim(line_.data());
    if (!text.empty() && text.front() != '#') return true;
  }
  return false;
}

void DiskFileReader::ReadHeader() {
  if (!NextLine()) Refuse("the file is empty; its first line must name the columns, such as x,y,radius");
  std::string_view text = line_.data();
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  for (const std::string_view field : Split(text)) {
    const auto& names = ColumnNames();
    const auto name = std::find(names.begin(), names.end(), field);
    if (name == names.end())
      Refuse(fmt::format("column '{}' is unknown; {}", field, Suggestion(field, names, "known columns")));
    const auto column = static_cast<std::size_t>(name - names.begin());
    if (std::find(columns_.begin(), columns_.end(), column) != columns_.end()) {
      Refuse(fmt::format("column '{}' is there twice; keep one", field));
    }
    columns_.push_back(column);
  }
  for (const std::size_t needed : {kX, kY, kRadius}) {
    if (std::find(columns_.begin(), columns_.end(), needed) == columns_.end()) {
      Refuse(fmt::format("column '{}' is missing; the first line must name x, y and radius", ColumnNames()[needed]));
    }
  }
  has_ids_ = std::find(columns_.begin(), columns_.end(), std::size_t{kId}) != columns_.end();
}

bool DiskFileReader::Next(DiskRow* row) {
  if (!NextLine()) return false;
  row->line = line_number_;
  const std::vector<std::string_view> fields = Split(line_.data());
  if (fields.size() != columns_.size()) {
    Refuse(fmt::format("{} fields where the first line names {} columns; give one value per column", fields.size(),
                       columns_.size()));
  }
  for (std::size_t i = 0; i < fields.size(); ++i) ReadField(columns_[i], fields[i], row);
  return true;
}

void DiskFileReader::ReadField(std::size_t column, std::string_view field, DiskRow* row) const {
  if (column == kMaterial) {
    row->material = field;
    return;
  }
  if (column == kId) {
    row->id = Parse<std::int64_t>(field);
    if (!row->id || *row->id < 0) Refuse(fmt::format("id '{}' is not an integer >= 0; give each disk its own", field));
    return;
  }
  const std::optional<double> number = Parse<double>(field);
  if (!number || !std::isfinite(*number))
    Refuse(fmt::format("{} '{}' is not a finite number; give one", ColumnNames()[column], field));
  if (column == kRadius && *number <= 0.0) Refuse(fmt::format("radius {} is not positive; give a length > 0 [m]", field));
  *Target(column, row) = *number;
}

}  // namespace nscdd
