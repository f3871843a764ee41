// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tradeoff/tradeoff_row.h"

namespace nscdd {

/// Writes FOLDER/tradeoff.gp (with the data in it) and has gnuplot draw FOLDER/tradeoff.png: error against seconds a step,
/// log-log, fronts highlighted. Returns what to tell the user: the picture's path, or why there is none.
std::string PlotTradeoff(const std::filesystem::path& folder, const std::string& title, const std::vector<TradeoffRow>& rows);

/// The gnuplot script that draws `picture`.
std::string PlotScript(const std::string& title, const std::vector<TradeoffRow>& rows, const std::string& picture);

}  // namespace nscdd
