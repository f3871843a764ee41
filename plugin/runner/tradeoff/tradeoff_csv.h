// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

}  // namespace nscdd
