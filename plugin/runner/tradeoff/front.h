// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tradeoff/tradeoff_row.h"

namespace nscdd {

/// What "accurate" means when settings are ranked; smaller is better.
enum class Accuracy { kNat, kNatMax, kVelocityError, kInterpenetration };

Accuracy ParseAccuracy(const std::string& name);  ///< Throws Error with the names that exist
std::string NameOf(Accuracy accuracy);
/// Number of the row; < 0: not measured in its view.
double ErrorOf(const TradeoffRow& row, Accuracy accuracy);

/// Rows that no other row beats: ascending in seconds, strictly falling in error. Unsound rows and those that did not measure
/// the error are left out. Indices into `rows`.
std::vector<std::size_t> ParetoFront(const std::vector<TradeoffRow>& rows, Accuracy accuracy);

/// The cheapest row whose error is at most 10^-k, for every k between the largest and the smallest error of the front.
struct DecadeChoice {
  int decade = 0;  ///< k
  std::size_t row = 0;
};
std::vector<DecadeChoice> CheapestByDecade(const std::vector<TradeoffRow>& rows, Accuracy accuracy);

/// The most accurate row that takes at most `seconds` a step.
std::optional<std::size_t> BestWithin(const std::vector<TradeoffRow>& rows, Accuracy accuracy, double seconds);

/// The cheapest sound row of the plugin that is at least as accurate as `other` in nat and in the largest interpenetration.
std::optional<std::size_t> CheapestAsGood(const std::vector<TradeoffRow>& rows, const TradeoffRow& other);

}  // namespace nscdd
