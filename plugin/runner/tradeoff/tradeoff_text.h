// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tradeoff/front.h"
#include "tradeoff/plan.h"

namespace nscdd {

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
