// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "extremes/extreme_map.h"
#include "results/csv.h"

namespace nscdd {
namespace {

constexpr int kNameWidth = 46, kCellWidth = 15;
constexpr const char* kVerdicts[] = {"holds", "limit", "refused", "silent_miss", "broken", "none"};  // in extremes.csv

std::string NameOf(const ExtremeCase& c) { return c.family + ": " + c.name; }

std::string Decade(double error) {
  if (error == 0.0) return "0";
  return std::isfinite(error) ? fmt::format("1e{}", static_cast<int>(std::ceil(std::log10(error)))) : "nan";
}

std::string CellOf(const Outcome& o) {
  if (o.verdict == Verdict::kNone) return "-";
  if (o.verdict == Verdict::kRefused) return "R refused";
  return fmt::format("{} {} {}", MarkOf(o), Decade(o.error), o.iterations);
}

}  // namespace

char MarkOf(const Outcome& o) {
  switch (o.verdict) {
    case Verdict::kNone:
      return ' ';
    case Verdict::kRefused:
      return 'R';
    case Verdict::kSilent:
      return '!';
    case Verdict::kBroken:
      return 'X';
    case Verdict::kHolds:
    case Verdict::kLimit:
      break;
  }
  if (o.status == "converged") return o.verdict == Verdict::kLimit ? 'W' : '.';
  return static_cast<char>(std::toupper(o.status == "iteration_limit" ? 'l' : o.status.front()));
}

std::string FormatHead(const ExtremeMap& map) {
  std::string line = fmt::format("{:<{}}", "", kNameWidth);
  for (const SolverColumn& column : map.columns) line += fmt::format("{:<{}}", column.name, kCellWidth);
  return line + "\n";
}

std::string FormatRow(const ExtremeMap& map, std::size_t row) {
  std::string line = fmt::format("{:<{}}", NameOf(map.cases[row]), kNameWidth);
  for (const Outcome& outcome : map.outcomes[row]) line += fmt::format("{:<{}}", CellOf(outcome), kCellWidth);
  return line + "\n";
}

std::string FormatSummary(const ExtremeMap& map) {
  std::string text;
  for (std::size_t k = 0; k < map.columns.size(); ++k) {
    int holds = 0, tried = 0;
    for (const auto& row : map.outcomes) {
      holds += row[k].verdict == Verdict::kHolds;
      tried += row[k].verdict != Verdict::kNone;
    }
    text += fmt::format("{:<15} holds in {} of {} cases\n", map.columns[k].name, holds, tried);
  }
  for (std::size_t i = 0; i < map.cases.size(); ++i) {
    for (std::size_t k = 0; k < map.columns.size(); ++k) {
      const Outcome& o = map.outcomes[i][k];
      if (o.verdict != Verdict::kSilent && o.verdict != Verdict::kBroken) continue;
      text += fmt::format("{}: {}, {}: error {:.2e} (bound {:.2e}), momentum {:.1e}, energy {:.1e}, {}: {}\n",
                          o.verdict == Verdict::kSilent ? "SILENT MISS" : "BROKEN", NameOf(map.cases[i]), map.columns[k].name,
                          o.error, o.bound, o.momentum, o.energy, o.status, o.sentence);
    }
  }
  return text;
}

int CountFailures(const ExtremeMap& map) {
  int count = 0;
  for (const auto& row : map.outcomes) {
    count += static_cast<int>(std::count_if(row.begin(), row.end(), [](const Outcome& o) {
      return o.verdict == Verdict::kSilent || o.verdict == Verdict::kBroken;
    }));
  }
  return count;
}

std::string FormatCsv(const ExtremeMap& map) {
  std::string text =
      "family,case,subdomains,criterion,tolerance,solver,verdict,status,error,bound,momentum,energy,iterations,contacts,"
      "nat,nat_max,sentence\n";
  for (std::size_t i = 0; i < map.cases.size(); ++i) {
    const ExtremeCase& c = map.cases[i];
    for (std::size_t k = 0; k < map.columns.size(); ++k) {
      const Outcome& o = map.outcomes[i][k];
      if (o.verdict == Verdict::kNone) continue;
      text += fmt::format("{},{},{},{},{},{},{},{},{:.3e},{:.1e},{:.1e},{:.1e},{},{},{:.3e},{:.3e},{}\n", c.family,
                          CsvQuoted(c.name), c.subdomains, c.criterion, c.tolerance, map.columns[k].name,
                          kVerdicts[static_cast<std::size_t>(o.verdict)], o.status, o.error, o.bound, o.momentum, o.energy,
                          o.iterations, o.contacts, o.nat, o.nat_max, CsvQuoted(o.sentence));
    }
  }
  return text;
}

}  // namespace nscdd
