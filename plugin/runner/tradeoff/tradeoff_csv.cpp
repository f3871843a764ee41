// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_output.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>

#include "nscdd/error.h"
#include "results/csv.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

std::string Options(const Setting& setting) {
  std::string text;
  for (const auto& [key, value] : setting.options) text += fmt::format("{}{}={}", text.empty() ? "" : ";", key, value);
  return text;
}

std::string NumberOrNothing(double value) { return value < 0.0 ? "" : fmt::format("{}", value); }

struct Column {
  const char* name;
  std::string (*text)(const TradeoffRow&);
};

#define NSCDD_NUMBER(name, member)                                             \
  Column {                                                                     \
    name, [](const TradeoffRow& row) { return fmt::format("{}", row.member); } \
  }
#define NSCDD_OPTIONAL(name)                                                \
  Column {                                                                  \
#name, [](const TradeoffRow& row) { return NumberOrNothing(row.name); } \
  }
#define NSCDD_SECONDS(name)                                                       \
  Column {                                                                        \
#name, [](const TradeoffRow& row) { return fmt::format("{:.4g}", row.name); } \
  }

const Column kColumns[] = {
    NSCDD_NUMBER("view", view),
    Column{"setting", [](const TradeoffRow& row) { return CsvClause(row.setting.name); }},
    NSCDD_NUMBER("solver", setting.solver),
    Column{"options", [](const TradeoffRow& row) { return Options(row.setting); }},
    NSCDD_NUMBER("substeps", setting.substeps),
    NSCDD_NUMBER("status", status),
    NSCDD_NUMBER("steps", steps),
    NSCDD_NUMBER("not_converged", not_converged),
    NSCDD_NUMBER("nat", nat),
    NSCDD_NUMBER("nat_worst", nat_worst),
    NSCDD_NUMBER("nat_max", nat_max),
    NSCDD_NUMBER("nat_max_worst", nat_max_worst),
    NSCDD_OPTIONAL(velocity_error),
    NSCDD_OPTIONAL(velocity_error_worst),
    NSCDD_OPTIONAL(worst_body),
    NSCDD_NUMBER("interpenetration_mean", interpenetration_mean),
    NSCDD_NUMBER("interpenetration_p99", interpenetration_p99),
    NSCDD_NUMBER("interpenetration_max", interpenetration_max),
    NSCDD_NUMBER("solver_growth_mean", growth.solver_mean),
    NSCDD_NUMBER("solver_growth_max", growth.solver_max),
    NSCDD_NUMBER("geometry_growth_mean", growth.geometry_mean),
    NSCDD_NUMBER("geometry_growth_max", growth.geometry_max),
    NSCDD_NUMBER("momentum_defect", momentum_defect),
    NSCDD_NUMBER("energy_defect", energy_defect),
    NSCDD_NUMBER("observable", observable),
    NSCDD_NUMBER("observable_error", observable_error),
    NSCDD_NUMBER("sweeps", sweeps),
    NSCDD_NUMBER("exchanges", exchanges),
    NSCDD_NUMBER("exchange_bytes", exchange_bytes),
    NSCDD_SECONDS(seconds),
    NSCDD_SECONDS(seconds_least),
    NSCDD_SECONDS(seconds_most),
    NSCDD_NUMBER("repetitions", repetitions),
    Column{"reason", [](const TradeoffRow& row) { return CsvClause(row.reason); }},
};

#undef NSCDD_NUMBER
#undef NSCDD_OPTIONAL
#undef NSCDD_SECONDS

}  // namespace

std::string TradeoffHeader() {
  std::string line;
  for (const Column& column : kColumns) line += fmt::format("{}{}", line.empty() ? "" : ",", column.name);
  return line + '\n';
}

std::string TradeoffLine(const TradeoffRow& row) {
  std::string line;
  for (const Column& column : kColumns) line += fmt::format("{}{}", &column == kColumns ? "" : ",", column.text(row));
  return line + '\n';
}

TradeoffCsv::TradeoffCsv(const std::filesystem::path& file) : file_(file) { ReplaceText(file_, TradeoffHeader()); }

void TradeoffCsv::Append(const TradeoffRow& row) {
  std::ofstream stream(file_, std::ios::app | std::ios::binary);
  stream << TradeoffLine(row);
  stream.close();
  if (!stream) throw Error(CannotWrite(file_, errno));
}

void TradeoffCsv::Rewrite(const std::vector<TradeoffRow>& rows) {
  std::string text = TradeoffHeader();
  for (const TradeoffRow& row : rows) text += TradeoffLine(row);
  ReplaceText(file_, text);
}

}  // namespace nscdd
