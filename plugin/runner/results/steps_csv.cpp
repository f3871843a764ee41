// SPDX-License-Identifier: Apache-2.0
#include "results/steps_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "nscdd/error.h"
#include "results/mapped_file.h"
#include "results/run_files.h"
#include "results/staged_file.h"

namespace nscdd {
namespace {

struct Column {
  const char* name;
  std::string (*text)(const StepRow&);
  bool (*read)(std::string_view, StepRow*);  ///< false: this is no such text
};

/// Shortest decimal that reads back as the same double, so equal bits give equal text and unequal ones do not.
template <auto Member>
std::string Plain(const StepRow& row) {
  return fmt::format("{}", row.*Member);
}

template <auto Member>
std::string Seconds(const StepRow& row) {
  return fmt::format("{:.6f}", row.*Member);
}

/// A clause without what would need quotes in a table.
template <auto Member>
std::string Clause(const StepRow& row) {
  std::string text = row.*Member;
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '"' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

template <auto Member>
bool Read(std::string_view text, StepRow* row) {
  auto& value = row->*Member;
  if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
    value = text;
    return true;
  } else {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
  }
}

#define NSCDD_COLUMN(kind, name) \
  Column { #name, kind < &StepRow::name>, Read < &StepRow::name> }

constexpr std::array kStepColumns = {
    NSCDD_COLUMN(Plain, step),
    NSCDD_COLUMN(Plain, time),
    NSCDD_COLUMN(Plain, contacts),
    NSCDD_COLUMN(Plain, active),
    NSCDD_COLUMN(Plain, iterations),
    NSCDD_COLUMN(Plain, status),
    NSCDD_COLUMN(Plain, nat),
    NSCDD_COLUMN(Plain, nat_max),
    NSCDD_COLUMN(Plain, qm16),
    NSCDD_COLUMN(Plain, interface_jump),
    NSCDD_COLUMN(Plain, mean_interpenetration),
    NSCDD_COLUMN(Plain, max_interpenetration),
    NSCDD_COLUMN(Plain, kinetic_energy),
    NSCDD_COLUMN(Plain, momentum_x),
    NSCDD_COLUMN(Plain, momentum_y),
    NSCDD_COLUMN(Seconds, seconds_detect),
    NSCDD_COLUMN(Seconds, seconds_solve),
    NSCDD_COLUMN(Seconds, seconds_communicate),
    NSCDD_COLUMN(Plain, sweeps),
    NSCDD_COLUMN(Plain, sticking),
    NSCDD_COLUMN(Plain, bodies),
    NSCDD_COLUMN(Plain, quad),
    NSCDD_COLUMN(Plain, maxm),
    NSCDD_COLUMN(Plain, relative_jump),
    NSCDD_COLUMN(Plain, interface_bodies),
    NSCDD_COLUMN(Plain, interface_copies),
    NSCDD_COLUMN(Plain, max_multiplicity),
    NSCDD_COLUMN(Plain, empty_subdomains),
    NSCDD_COLUMN(Plain, painleve_contacts),
    NSCDD_COLUMN(Plain, interface_updates),
    NSCDD_COLUMN(Plain, cg_iterations),
    NSCDD_COLUMN(Plain, cg_failures),
    NSCDD_COLUMN(Plain, factorisations),
    NSCDD_COLUMN(Plain, injected_energy),
    NSCDD_COLUMN(Plain, max_drift),
    NSCDD_COLUMN(Plain, alert_distance),
    NSCDD_COLUMN(Plain, mean_radius),
    NSCDD_COLUMN(Plain, worst_body_a),
    NSCDD_COLUMN(Plain, worst_body_b),
    NSCDD_COLUMN(Plain, unknowns_per_contact),
    NSCDD_COLUMN(Plain, unknowns_per_body),
    NSCDD_COLUMN(Plain, bytes_per_contact),
    NSCDD_COLUMN(Plain, bytes_per_body),
    NSCDD_COLUMN(Seconds, seconds_total),
    NSCDD_COLUMN(Seconds, seconds_interface),
    NSCDD_COLUMN(Clause, reason),
};

constexpr std::array kCommunicationColumns = {
    NSCDD_COLUMN(Plain, step),          NSCDD_COLUMN(Plain, migrated_bodies), NSCDD_COLUMN(Plain, messages),
    NSCDD_COLUMN(Plain, message_bytes), NSCDD_COLUMN(Plain, collectives),
};

#undef NSCDD_COLUMN

template <class Columns, class Cell>
std::string Line(const Columns& columns, Cell cell) {
  std::string line;
  for (const Column& column : columns) {
    if (!line.empty()) line += ',';
    line += cell(column);
  }
  line += '\n';
  return line;
}

template <class Columns>
std::string Header(const Columns& columns) {
  return Line(columns, [](const Column& column) { return column.name; });
}

template <class Columns>
std::string Row(const Columns& columns, const StepRow& row) {
  return Line(columns, [&](const Column& column) { return column.text(row); });
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
template <class Columns>
class RowReader {
 public:
  RowReader(const std::filesystem::path& path, std::uint64_t size, const Columns& columns)
      : path_(path), file_(path), rest_(file_.text().substr(0, size)), columns_(columns) {
    if (TakeLine() + "\n" != Header(columns)) Refuse();
  }

  bool empty() const { return rest_.empty(); }

  void Take(StepRow* row) {
    std::string line = TakeLine() + ",";
    std::string_view cells = line;
    for (const Column& column : columns_) {
      const auto comma = cells.find(',');
      if (comma == std::string_view::npos || !column.read(cells.substr(0, comma), row)) Refuse();
      cells.remove_prefix(comma + 1);
    }
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
  const Columns& columns_;
  std::int64_t line_ = 0;
};

}  // namespace

void ForEachStepRow(const std::filesystem::path& folder, const std::vector<FileExtent>& kept,
                    const std::function<void(const StepRow&)>& visit) {
  const FileExtent *steps = Find(kept, PartOf(kSteps)), *communication = Find(kept, PartOf(kCommunication));
  if (steps == nullptr) throw Error(fmt::format("the checkpoint in {} does not name {}.", folder.string(), PartOf(kSteps)));
  RowReader rows(folder / steps->name, steps->size, kStepColumns);
  std::optional<RowReader<decltype(kCommunicationColumns)>> sent;
  if (communication != nullptr) sent.emplace(folder / communication->name, communication->size, kCommunicationColumns);
  StepRow next;  // of communication.csv, which may begin later
  while (!rows.empty()) {
    StepRow row;
    rows.Take(&row);
    if (sent && next.step < row.step && !sent->empty()) sent->Take(&next);
    if (next.step == row.step) {
      row.migrated_bodies = next.migrated_bodies;
      row.messages = next.messages;
      row.message_bytes = next.message_bytes;
      row.collectives = next.collectives;
    }
    visit(row);
  }
}

StepsCsv::StepsCsv(ResultsFolder* folder) : folder_(folder) {
  folder->ranks().RunOnRoot([&] {
    steps_ = Begin(folder->Stage(kSteps), Header(kStepColumns));
    if (!folder->ranks().is_serial()) communication_ = Begin(folder->Stage(kCommunication), Header(kCommunicationColumns));
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
      communication_ = Begin(folder->Stage(kCommunication), Header(kCommunicationColumns));
    }
  });
}

StepsCsv::~StepsCsv() = default;

void StepsCsv::Append(const StepRow& row) {
  folder_->KeepParts();
  folder_->ranks().RunOnRoot([&] {
    steps_->Write(Row(kStepColumns, row));
    if (communication_) communication_->Write(Row(kCommunicationColumns, row));
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
