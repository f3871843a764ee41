#include "results/steps_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "results/staged_file.h"

namespace nscdd {
namespace {

using Text = std::string (*)(const StepRow&);

struct Column {
  const char* name;
  Text text;
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
std::string Reason(const StepRow& row) {
  std::string text = row.reason;
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '"' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

#define NSCDD_COLUMN(kind, name) \
  Column { #name, kind < &StepRow::name> }

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
    NSCDD_COLUMN(Seconds, seconds_total),
    NSCDD_COLUMN(Seconds, seconds_interface),
    Column{"reason", Reason},
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

}  // namespace

StepsCsv::StepsCsv(ResultsFolder* folder) : folder_(folder) {
  folder->ranks().RunOnRoot([&] {
    steps_ = std::make_unique<StagedFile>(folder->Stage("steps.csv"));
    steps_->Write(Header(kStepColumns));
    if (folder->ranks().is_serial()) return;
    communication_ = std::make_unique<StagedFile>(folder->Stage("communication.csv"));
    communication_->Write(Header(kCommunicationColumns));
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

void StepsCsv::Close() {
  folder_->ranks().RunOnRoot([&] {
    steps_->Close();
    if (communication_) communication_->Close();
  });
}

}  // namespace nscdd
