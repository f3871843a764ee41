// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "nscdd/error.h"
#include "scene/text.h"

namespace nscdd {
namespace {

// In the order of the enumerators.
constexpr std::array kNames = {"nat", "nat_max", "velocity_error", "interpenetration"};

/// Sound rows with a finite error, the cheapest first, of equal seconds the most accurate.
std::vector<std::size_t> Ranked(const std::vector<TradeoffRow>& rows, Accuracy accuracy) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double error = ErrorOf(rows[i], accuracy);
    if (rows[i].is_sound() && std::isfinite(error) && error >= 0.0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(rows[a].seconds, ErrorOf(rows[a], accuracy)) < std::pair(rows[b].seconds, ErrorOf(rows[b], accuracy));
  });
  return order;
}

}  // namespace

Accuracy ParseAccuracy(const std::string& name) {
  const std::vector<std::string> names(kNames.begin(), kNames.end());
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    throw Error(fmt::format("--accuracy: there is no '{}'; {}", name, Suggestion(name, names, "measures")));
  return static_cast<Accuracy>(at - names.begin());
}

std::string NameOf(Accuracy accuracy) { return kNames[static_cast<std::size_t>(accuracy)]; }

double ErrorOf(const TradeoffRow& row, Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::kNat:
      return row.nat;
    case Accuracy::kNatMax:
      return row.nat_max;
    case Accuracy::kVelocityError:
      return row.velocity_error;
    case Accuracy::kInterpenetration:
      break;
  }
  return row.interpenetration_max;
}

std::vector<std::size_t> ParetoFront(const std::vector<TradeoffRow>& rows, Accuracy accuracy) {
  std::vector<std::size_t> front;
  for (const std::size_t i : Ranked(rows, accuracy)) {
    if (front.empty() || ErrorOf(rows[i], accuracy) < ErrorOf(rows[front.back()], accuracy)) front.push_back(i);
  }
  return front;
}

std::vector<DecadeChoice> CheapestByDecade(const std::vector<TradeoffRow>& rows, Accuracy accuracy) {
  constexpr int kSmallest = 16;  // rounding
  const std::vector<std::size_t> front = ParetoFront(rows, accuracy);
  std::vector<DecadeChoice> choices;
  if (front.empty()) return choices;
  const auto decade_of = [&](std::size_t row) {
    const double error = std::max(ErrorOf(rows[row], accuracy), std::pow(10.0, -kSmallest));
    return static_cast<int>(std::floor(-std::log10(error) + 1e-9));
  };
  for (const std::size_t row : front) {
    const int first = choices.empty() ? decade_of(row) : choices.back().decade + 1;
    for (int k = first; k <= decade_of(row); ++k) choices.push_back({k, row});
  }
  return choices;
}

std::optional<std::size_t> BestWithin(const std::vector<TradeoffRow>& rows, Accuracy accuracy, double seconds) {
  std::optional<std::size_t> best;
  for (const std::size_t i : ParetoFront(rows, accuracy)) {
    if (rows[i].seconds <= seconds) best = i;
  }
  return best;
}

std::optional<std::size_t> CheapestAsGood(const std::vector<TradeoffRow>& rows, const TradeoffRow& other) {
  for (const std::size_t i : Ranked(rows, Accuracy::kNat)) {
    const TradeoffRow& row = rows[i];
    if (!row.setting.is_box2d() && row.nat <= other.nat && row.interpenetration_max <= other.interpenetration_max) return i;
  }
  return {};
}

}  // namespace nscdd
