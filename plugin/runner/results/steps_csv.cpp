// SPDX-License-Identifier: Apache-2.0
#include "results/steps_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "nscdd/error.h"
#include "results/mapped_file.h"
#include "results/run_files.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

/// One of the two tables: which figures are its columns.
using IsColumn = bool (*)(const Figure&);

bool OfSteps(const Figure& figure) { return figure.kind == FigureKind::kResult || figure.kind == FigureKind::kSeconds; }
bool OfCommunication(const Figure& figure) {
  return figure.kind == FigureKind::kTraffic || figure.name == std::string_view("step");
}

std::string Text(const Figure&, std::int64_t count) { return fmt::format("{}", count); }

/// The shortest decimal that reads back as the same double, so equal bits give equal text and unequal ones do not.
std::string Text(const Figure& figure, double value) {
  return figure.kind == FigureKind::kSeconds ? fmt::format("{:.6f}", value) : fmt::format("{}", value);
}

std::string Text(const Figure&, SolveStatus status) { return NameOf(status); }

/// A clause without what would need quotes in a table.
std::string Text(const Figure&, std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '"' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// False: this is no such text.
template <class Number>
bool Read(std::string_view text, Number* value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *value);
  return error == std::errc{} && end == text.data() + text.size();
}

bool Read(std::string_view text, SolveStatus* status) {
  const std::optional<SolveStatus> found = FindStatus(text);
  if (found) *status = *found;
  return found.has_value();
}

bool Read(std::string_view text, std::string* value) {
  *value = text;
  return true;
}

/// A line of the cells that `cell` makes of the figures that are columns, and of their values in `step`.
template <class Cell>
std::string Line(IsColumn is_column, const StepReport& step, Cell cell) {
  std::string line;
  const auto add = [&](const Figure& figure, const auto& value) {
    if (!is_column(figure)) return;
    line += cell(figure, value);
    line += ',';
  };
  ForEachFigure(add, step);
  line.back() = '\n';
  return line;
}

std::string Header(IsColumn is_column) {
  return Line(is_column, {}, [](const Figure& figure, const auto&) { return figure.name; });
}

std::string Row(IsColumn is_column, const StepReport& step) {
  return Line(is_column, step, [](const Figure& figure, const auto& value) { return Text(figure, value); });
}

constexpr const char* kSteps = "steps.csv";
constexpr const char* kCommunication = "communication.csv";

std::unique_ptr<StagedFile> Begin(const std::filesystem::path& path, const std::string& header) {
  auto file = std::make_unique<StagedFile>(path);
  file->Write(header);
  return file;
}

/// Null if there is none.
const FileExtent* Find(const std::vector<FileExtent>& kept, const std::string& name) {
  const auto at = std::find_if(kept.begin(), kept.end(), [&](const FileExtent& e) { return e.name == name; });
  return at == kept.end() ? nullptr : &*at;
}

/// Takes rows off the beginning of a file.
class RowReader {
 public:
  RowReader(const std::filesystem::path& path, std::uint64_t size, IsColumn is_column)
      : path_(path), file_(path), rest_(file_.text().substr(0, size)), is_column_(is_column) {
    if (TakeLine() + "\n" != Header(is_column)) Refuse();
  }

  bool empty() const { return rest_.empty(); }

  void Take(StepReport* step) {
    const std::string line = TakeLine() + ",";
    std::string_view cells = line;
    const auto read = [&](const Figure& figure, auto& value) {
      if (!is_column_(figure)) return;
      const auto comma = cells.find(',');
      if (comma == std::string_view::npos || !Read(cells.substr(0, comma), &value)) Refuse();
      cells.remove_prefix(comma + 1);
    };
    ForEachFigure(read, *step);
    if (!cells.empty()) Refuse();
  }

 private:
  std::string TakeLine() {
    ++line_;
    const auto end = rest_.find('\n');
    if (end == std::string_view::npos) Refuse();
    const std::string line(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return line;
  }

  [[noreturn]] void Refuse() const {
    throw Error(fmt::format("{}:{}: is not a row of this program: use the program that wrote it.", path_.string(), line_));
  }

  std::filesystem::path path_;
  MappedFile file_;
  std::string_view rest_;
  IsColumn is_column_;
  std::int64_t line_ = 0;
};

}  // namespace

void ForEachStep(const std::filesystem::path& folder, const std::vector<FileExtent>& kept,
                 const std::function<void(const StepReport&)>& visit) {
  const FileExtent *steps = Find(kept, PartOf(kSteps)), *communication = Find(kept, PartOf(kCommunication));
  if (steps == nullptr) throw Error(fmt::format("the checkpoint in {} does not name {}.", folder.string(), PartOf(kSteps)));
  RowReader rows(folder / steps->name, steps->size, OfSteps);
  std::optional<RowReader> sent;
  if (communication != nullptr) sent.emplace(folder / communication->name, communication->size, OfCommunication);
  StepReport next;  // of communication.csv, which may begin later
  while (!rows.empty()) {
    StepReport step;
    rows.Take(&step);
    if (sent && next.step < step.step && !sent->empty()) sent->Take(&next);
    const auto take = [](const Figure& figure, auto& to, const auto& from) {
      if (figure.kind == FigureKind::kTraffic) to = from;
    };
    if (next.step == step.step) ForEachFigure(take, step, next);
    visit(step);
  }
}

StepsCsv::StepsCsv(ResultsFolder* folder) : folder_(folder) {
  folder->ranks().RunOnRoot([&] {
    steps_ = Begin(folder->Stage(kSteps), Header(OfSteps));
    if (!folder->ranks().is_serial()) communication_ = Begin(folder->Stage(kCommunication), Header(OfCommunication));
  });
}

StepsCsv::StepsCsv(ResultsFolder* folder, const std::vector<FileExtent>& kept) : folder_(folder) {
  folder->ranks().RunOnRoot([&] {
    const auto go_on = [&](const char* name, const FileExtent* extent) {
      return std::make_unique<StagedFile>(folder->Stage(name), extent->size);
    };
    steps_ = go_on(kSteps, Find(kept, PartOf(kSteps)));
    const FileExtent* communication = Find(kept, PartOf(kCommunication));
    if (communication != nullptr) {
      communication_ = go_on(kCommunication, communication);
    } else if (!folder->ranks().is_serial()) {
      communication_ = Begin(folder->Stage(kCommunication), Header(OfCommunication));
    }
  });
}

StepsCsv::~StepsCsv() = default;

void StepsCsv::Append(const StepReport& step) {
  folder_->KeepParts();
  folder_->ranks().RunOnRoot([&] {
    steps_->Write(Row(OfSteps, step));
    if (communication_) communication_->Write(Row(OfCommunication, step));
  });
}

std::vector<FileExtent> StepsCsv::Keep() {
  std::vector<FileExtent> kept;
  folder_->ranks().RunOnRoot([&] {
    const auto keep = [&](const char* name, const StagedFile& file) {
      SyncToDisk(folder_->Stage(name));
      kept.push_back({PartOf(name), file.size(), file.crc()});
    };
    keep(kSteps, *steps_);
    if (communication_) keep(kCommunication, *communication_);
  });
  return kept;
}

void StepsCsv::Close() {
  folder_->ranks().RunOnRoot([&] {
    steps_->Close();
    if (communication_) communication_->Close();
  });
}

}  // namespace nscdd
