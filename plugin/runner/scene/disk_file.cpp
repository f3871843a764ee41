// SPDX-License-Identifier: Apache-2.0
#include "scene/disk_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "nscdd/error.h"
#include "scene/csv_cells.h"
#include "scene/text.h"

namespace nscdd {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Rows of final.csv that the scene makes in another way.
bool IsLeftOut(std::string_view kind) { return kind == "wall" || kind == "cluster"; }

/// The names in a comment above the rows; "#format x_y_z_r" is YADE's.
std::vector<std::string_view> NamesIn(std::string_view comment) {
  std::vector<std::string_view> names;
  comment = Trim(comment.substr(std::min(comment.find_first_not_of('#'), comment.size())));
  if (!SplitLine(comment, FindSeparator(comment), &names)) return {};
  if (names.size() != 2 || names[0] != "format") return names;
  std::string_view format = names[1];
  names.clear();
  for (std::size_t end = 0; end != std::string_view::npos; format.remove_prefix(std::min(end + 1, format.size()))) {
    end = format.find('_');
    names.push_back(format.substr(0, end));
  }
  return names;
}

double* Target(DiskColumn column, DiskRow* row) {
  switch (column) {
    case DiskColumn::kX:
      return &row->pose.x;
    case DiskColumn::kY:
      return &row->pose.y;
    case DiskColumn::kZ:
      return &row->z;
    case DiskColumn::kAngle:
      return &row->pose.angle;
    case DiskColumn::kVx:
      return &row->velocity.vx;
    case DiskColumn::kVy:
      return &row->velocity.vy;
    case DiskColumn::kSpin:
      return &row->velocity.spin;
    default:
      return &row->radius;
  }
}

}  // namespace

DiskFileReader::DiskFileReader(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) stream_.open(path);
  if (!stream_.is_open())
    throw Error(fmt::format("{}: cannot be read; check that this table is there and readable.", path.string()));
  ReadHead();
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
  if (std::exchange(held_, false)) return true;
  while (!stream_.eof()) {
    ++line_number_;
    // Sets failbit when the line fills the array, and with eofbit when there is no further line.
    stream_.getline(line_.data(), line_.size());
    if (stream_.bad()) Refuse("reading failed here; check the disk");
    if (stream_.fail() && !stream_.eof())
      Refuse(fmt::format("the line is longer than {} characters; give one disk per line", line_.size() - 2));
    // A zero byte would hide the rest of its line.
    const auto read = static_cast<std::size_t>(stream_.gcount()) - (stream_.eof() || stream_.gcount() == 0 ? 0 : 1);
    std::string_view text(line_.data(), read);
    CheckText(text);
    if (line_number_ == 1 && text.starts_with(kByteOrderMark)) {
      std::fill_n(line_.begin(), kByteOrderMark.size(), ' ');
    }
    text = Trim(text);
    if (!text.empty() && text.front() != '#') return true;
    if (columns_.meaning.empty()) ConsiderComment(text);
  }
  return false;
}

void DiskFileReader::ConsiderComment(std::string_view text) {
  const DiskColumns columns = ColumnsNamed(NamesIn(text));
  if (columns.fault.empty()) comment_ = text;
}

void DiskFileReader::ReadHead() {
  if (!NextLine())
    Refuse("the file has no line with names or numbers; its first line must name the columns, such as x,y,radius");
  separator_ = FindSeparator(line_.data());
  SplitFields();
  const auto is_number = [](std::string_view field) { return CsvNumber(field).has_value(); };
  if (std::any_of(fields_.begin(), fields_.end(), is_number)) return TakeRowWithoutHeader();
  if (fields_.front() == "ITEM:") {
    Refuse(
        "this is a dump of LAMMPS or LIGGGHTS; keep the lines of one time step, and the line above them from 'ITEM: ATOMS' on "
        "without these two words");
  }
  TakeNames(fields_);
}

void DiskFileReader::TakeNames(const std::vector<std::string_view>& names) {
  columns_ = ColumnsNamed(names);
  if (!columns_.fault.empty()) Refuse(columns_.fault);
}

/// The first line with something in it is a row already: its columns are named by a comment above it, or go by position.
void DiskFileReader::TakeRowWithoutHeader() {
  held_ = true;
  if (!comment_.empty()) {
    TakeNames(NamesIn(comment_));
    if (fields_.size() == columns_.meaning.size()) return;
    Refuse(fmt::format("{} fields where the comment above, '{}', names {} columns; make it name each column, or none",
                       fields_.size(), comment_, columns_.meaning.size()));
  }
  named_ = false;
  columns_ = ColumnsByPosition(fields_.size());
  if (!columns_.fault.empty()) Refuse(columns_.fault);
  if (separator_ == Separator::kComma && fields_.size() > 3) {
    Refuse(
        "numbers between commas and no names of columns, where some commas may be decimal marks; write the names above, such "
        "as "
        "x,y,z,radius");
  }
}

void DiskFileReader::SplitFields() {
  if (!SplitLine(line_.data(), separator_, &fields_)) Refuse("a double quote is opened but not closed; close or remove it");
}

/// Leaves the fields of the next disk in fields_.
bool DiskFileReader::NextDisk() {
  while (NextLine()) {
    SplitFields();
    if (fields_.size() != columns_.meaning.size()) {
      Refuse(fmt::format("{} fields where the {} {} columns; give one value per column{}", fields_.size(),
                         named_ ? "header names" : "first row has", columns_.meaning.size(),
                         separator_ == Separator::kComma ? ", with decimal points if commas separate them" : ""));
    }
    const auto kind = std::find(columns_.meaning.begin(), columns_.meaning.end(), DiskColumn::kKind);
    if (kind == columns_.meaning.end() || !IsLeftOut(fields_[static_cast<std::size_t>(kind - columns_.meaning.begin())]))
      return true;
    ++left_out_;
  }
  return false;
}

bool DiskFileReader::Skip() { return columns_.Has(DiskColumn::kKind) ? NextDisk() : NextLine(); }

bool DiskFileReader::Next(DiskRow* row) {
  if (!NextDisk()) return false;
  row->line = line_number_;
  for (std::size_t i = 0; i < fields_.size(); ++i) ReadField(columns_.meaning[i], fields_[i], row);
  return true;
}

void DiskFileReader::ReadField(DiskColumn column, std::string_view field, DiskRow* row) {
  switch (column) {
    case DiskColumn::kUnused:
      return;
    case DiskColumn::kMaterial:
      row->material = field;
      return;
    case DiskColumn::kKind:
      return ReadKind(field, row);
    case DiskColumn::kId:
      row->id = CsvId(field);
      if (!row->id)
        Refuse(fmt::format("id '{}' is not an integer >= 0; give each disk its own, or leave the column out", field));
      return;
    default:
      *Target(column, row) = ReadNumber(column, field) * (column == DiskColumn::kDiameter ? 0.5 : 1.0);
  }
}

double DiskFileReader::ReadNumber(DiskColumn column, std::string_view field) {
  const std::string_view name = NameOf(column);
  const std::optional<double> number = CsvNumber(field);
  if (!number) Refuse(fmt::format("{} '{}' is not a finite number; give one, such as 1.5 or 1e-3", name, field));
  const bool is_size = column == DiskColumn::kRadius || column == DiskColumn::kDiameter;
  if (is_size && !(*number * 0.5 > 0.0)) Refuse(fmt::format("{} {} is not positive; give a length > 0 [m]", name, field));
  const auto mark = field.find_first_of(".,");
  if (mark != std::string_view::npos) {
    if (decimal_mark_ == '\0') decimal_mark_ = field[mark];
    if (decimal_mark_ != field[mark]) {
      Refuse(fmt::format("{} '{}' has a decimal '{}' where numbers before have '{}'; write all with the same", name, field,
                         field[mark], decimal_mark_));
    }
  }
  return *number;
}

void DiskFileReader::ReadKind(std::string_view field, DiskRow* row) const {
  if (field == "free" || field == "0") {
    row->kind = BodyKind::kFree;
  } else if (field == "prescribed" || field == "1") {
    row->kind = BodyKind::kPrescribed;
  } else if (!field.empty()) {
    Refuse(fmt::format("kind '{}' is not free, prescribed, wall or cluster; give one of these or rename the column", field));
  }
}

std::vector<std::string> DiskFileReader::Remarks() const {
  std::vector<std::string> remarks;
  const std::string file = path_.string();
  if (!named_) {
    const char* order = columns_.meaning.size() == 4 ? "x, y, z, radius" : "x, y, radius";
    remarks.push_back(Sentence(fmt::format("{}: names no columns; they were read as {}", file, order)));
  }
  if (!columns_.unused.empty()) {
    const bool one = columns_.unused.size() == 1;
    remarks.push_back(Sentence(fmt::format("{}: column{} {} {} not used", file, one ? "" : "s",
                                           fmt::join(columns_.unused, ", "), one ? "is" : "are")));
  }
  if (left_out_ > 0) {
    const bool one = left_out_ == 1;
    remarks.push_back(
        Sentence(fmt::format("{}: {} wall{} or cluster{} left out, as a table holds disks; the scene has to give them", file,
                             left_out_, one ? "" : "s", one ? " is" : "s are")));
  }
  return remarks;
}

}  // namespace nscdd
