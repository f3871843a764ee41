// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tradeoff/plan.h"
#include "tradeoff/tradeoff_row.h"

namespace nscdd {

/// tradeoff.csv: a row a setting and view, appended as measured, so that a run that is killed leaves what it has. Throws Error,
/// naming the file, when the system refuses.
class TradeoffCsv {
 public:
  /// Begins the file.
  explicit TradeoffCsv(const std::filesystem::path& file);
  void Append(const TradeoffRow& row);
  /// The whole file anew, for rows whose seconds are better known now. The old one stays until the new one is complete.
  void Rewrite(const std::vector<TradeoffRow>& rows);

 private:
  std::filesystem::path file_;
};

/// The header line and the line of a row, ended by '\n'. Numbers read back the same; what was not measured is empty.
std::string TradeoffHeader();
std::string TradeoffLine(const TradeoffRow& row);

/// Writes FOLDER/tradeoff.gp (with the data in it) and has gnuplot draw FOLDER/tradeoff.png: error against seconds a step,
/// log-log, fronts highlighted. Returns what to tell the user: the picture's path, or why there is none.
std::string PlotTradeoff(const std::filesystem::path& folder, const std::string& title, const std::vector<TradeoffRow>& rows);

/// The gnuplot script that draws `picture`.
std::string PlotScript(const std::string& title, const std::vector<TradeoffRow>& rows, const std::string& picture);

/// What the sentences at the end are about.
struct Wish {
  Accuracy accuracy = Accuracy::kNat;
  std::optional<double> budget;  ///< [s] a step
};

/// Rows of one view, in order.
std::vector<TradeoffRow> OfView(const std::vector<TradeoffRow>& rows, const std::string& view);

/// A table of the rows of one view, '*' before those on the front of `accuracy`. `all` false: the front, Box2D's rows, the
/// scene's own setting and whatever is not sound.
std::string FormatTable(const std::vector<TradeoffRow>& rows, Accuracy accuracy, bool all);

/// For every row of Box2D the cheapest setting that is at least as good in nat and largest interpenetration. Empty without such
/// rows.
std::string FormatBox2dComparison(const std::vector<TradeoffRow>& rows);

/// The cheapest setting for each decade of the accuracy and the best one within the budget, each as a [solver] section that a
/// scene file takes. Rows of one view; only advisable ones are proposed. `plan` adds the options that all settings share.
std::string FormatAdvice(const std::vector<TradeoffRow>& rows, const Wish& wish, const Plan& plan);

}  // namespace nscdd
