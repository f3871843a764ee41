// SPDX-License-Identifier: Apache-2.0
// The tables of README.md are those of nscdd/figures.h.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "nscdd/report.h"
#include "results_sample.h"

namespace nscdd {
namespace {

/// A bar would end the cell.
std::string Cell(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? "\\|" : std::string(1, c);
  return cell;
}

std::string FigureTable(const std::function<bool(FigureKind)>& is_shown) {
  std::string table = "| column | unit | |\n|---|---|---|\n";
  const StepReport any;
  const auto add = [&](const Figure& figure, const auto&) {
    if (is_shown(figure.kind)) table += fmt::format("| `{}` | {} | {} |\n", figure.name, figure.unit, Cell(figure.help));
  };
  ForEachFigure(add, any);
  return table;
}

void ExpectInReadme(const std::string& table) {
  const std::string readme = TextOf(std::string(NSCDD_SOURCE_DIR) + "/plugin/runner/results/README.md");
  EXPECT_NE(readme.find("\n\n" + table + "\n"), std::string::npos) << "plugin/runner/results/README.md must have the table\n"
                                                                   << table;
}

TEST(Figures, ReadmeListsTheColumnsOfSteps) {
  ExpectInReadme(FigureTable([](FigureKind kind) { return kind == FigureKind::kResult || kind == FigureKind::kSeconds; }));
}

TEST(Figures, ReadmeListsTheColumnsOfCommunication) {
  ExpectInReadme(FigureTable([](FigureKind kind) { return kind == FigureKind::kTraffic; }));
}

TEST(Figures, ReadmeListsTheStatuses) {
  std::string table = "| status | |\n|---|---|\n";
  for (const StatusWord& status : kStatuses) table += fmt::format("| `{}` | {} |\n", status.word, Cell(status.help));
  ExpectInReadme(table);
}

TEST(Figures, HaveNamesOfTheirOwnAndAHelp) {
  std::set<std::string> names;
  const StepReport any;
  const auto check = [&](const Figure& figure, const auto&) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
    EXPECT_STRNE(figure.unit, "") << figure.name;
    EXPECT_STRNE(figure.help, "") << figure.name;
  };
  ForEachFigure(check, any);
}

}  // namespace
}  // namespace nscdd
