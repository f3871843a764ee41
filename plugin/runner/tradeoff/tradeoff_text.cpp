// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nscdd {
namespace {

constexpr std::size_t kNameWidth = 34;

std::string Number(double value) { return value < 0.0 ? "" : fmt::format("{:.1e}", value); }

std::string Milliseconds(double seconds) { return fmt::format("{:.3g}", 1e3 * seconds); }

bool IsOn(const std::vector<std::size_t>& front, std::size_t row) {
  return std::find(front.begin(), front.end(), row) != front.end();
}

std::string Line(const TradeoffRow& row, bool on_front) {
  const std::string status =
      row.not_converged > 0 ? fmt::format("{} {}/{}", row.status, row.not_converged, row.steps) : row.status;
  return fmt::format("{} {:<{}}  {:<20}  {:>8}  {:>7.0f}  {:>7.0f}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}\n",
                     on_front ? '*' : ' ', row.setting.name, kNameWidth, status, Milliseconds(row.seconds), row.sweeps,
                     row.exchanges, Number(row.nat), Number(row.nat_max), Number(row.velocity_error),
                     Number(row.interpenetration_mean), Number(row.interpenetration_max), Number(row.growth.solver_max));
}

std::vector<TradeoffRow> Advisable(const std::vector<TradeoffRow>& rows) {
  std::vector<TradeoffRow> some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some), [](const TradeoffRow& r) { return r.is_advisable(); });
  return some;
}

std::string Section(const Setting& setting, const Plan& plan) {
  Setting complete = plan.Complete(setting);
  std::erase_if(complete.options, [](const auto& option) { return option.first == "theta"; });  // is in [time]
  return SolverSection(complete);
}

}  // namespace

std::vector<TradeoffRow> OfView(const std::vector<TradeoffRow>& rows, const std::string& view) {
  std::vector<TradeoffRow> own;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(own), [&](const TradeoffRow& r) { return r.view == view; });
  return own;
}

std::string FormatTable(const std::vector<TradeoffRow>& rows, Accuracy accuracy, bool all) {
  const std::vector<std::size_t> front = ParetoFront(rows, accuracy);
  std::string text =
      fmt::format("  {:<{}}  {:<20}  {:>8}  {:>7}  {:>7}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}\n", "setting", kNameWidth,
                  "status", "ms/step", "sweeps", "exch.", "nat", "nat_max", "V error", "pen mean", "pen max", "grow max");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool shown =
        all || IsOn(front, i) || rows[i].setting.is_box2d() || rows[i].setting.name == kSceneSetting || !rows[i].is_sound();
    if (shown) text += Line(rows[i], IsOn(front, i));
  }
  return text;
}

std::string FormatBox2dComparison(const std::vector<TradeoffRow>& rows) {
  std::string text;
  for (const TradeoffRow& row : rows) {
    if (!row.setting.is_box2d() || !row.is_sound()) continue;
    const auto found = CheapestAsGood(rows, row);
    if (!found) {
      text += fmt::format("{}: no setting is at least as good in nat ({:.1e}) and largest interpenetration ({:.1e})\n",
                          row.setting.name, row.nat, row.interpenetration_max);
      continue;
    }
    const TradeoffRow& ours = rows[*found];
    text += fmt::format(
        "{}: {} is at least as good (nat {:.1e} against {:.1e}, largest interpenetration {:.1e} against {:.1e}) and {:.1f} "
        "times {}\n",
        row.setting.name, ours.setting.name, ours.nat, row.nat, ours.interpenetration_max, row.interpenetration_max,
        ours.seconds <= row.seconds ? row.seconds / ours.seconds : ours.seconds / row.seconds,
        ours.seconds <= row.seconds ? "faster" : "slower");
  }
  if (!text.empty()) {
    text +=
        "Box2D's answers are measured with its own surface, the skins of edges and polygons included. More of its iterations "
        "are "
        "not more quality on piles: a pyramid that stands with 8/3 may fall with 20/10 (sample_scenes/tradeoff/README.md, "
        "Piles).\n";
  }
  return text;
}

std::string FormatAdvice(const std::vector<TradeoffRow>& rows, const Wish& wish, const Plan& plan) {
  const std::vector<TradeoffRow> ours = Advisable(rows);
  const std::string measure = NameOf(wish.accuracy);
  std::string text;
  std::optional<std::size_t> last;
  for (const DecadeChoice& choice : CheapestByDecade(ours, wish.accuracy)) {
    const TradeoffRow& row = ours[choice.row];
    text += fmt::format("# {} <= 1e{}: {}, {} ms a step, {} {:.1e}", measure, -choice.decade, row.setting.name,
                        Milliseconds(row.seconds), measure, ErrorOf(row, wish.accuracy));
    text += choice.row == last ? " (the same)\n" : fmt::format("\n{}", Section(row.setting, plan));
    last = choice.row;
  }
  if (text.empty()) text = fmt::format("# no setting has a {}\n", measure);
  if (!wish.budget) return text;
  const auto best = BestWithin(ours, wish.accuracy, *wish.budget);
  if (!best) return text + fmt::format("# no setting takes at most {} ms a step\n", Milliseconds(*wish.budget));
  const TradeoffRow& row = ours[*best];
  return text + fmt::format("# the most accurate within {} ms a step: {}, {} ms a step, {} {:.1e}\n{}",
                            Milliseconds(*wish.budget), row.setting.name, Milliseconds(row.seconds), measure,
                            ErrorOf(row, wish.accuracy), Section(row.setting, plan));
}

}  // namespace nscdd
