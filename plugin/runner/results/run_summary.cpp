// SPDX-License-Identifier: Apache-2.0
#include "results/run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace nscdd {
namespace {

/// Larger of the two; not a number if one of them is not.
template <class Number>
Number WorstOf(Number a, Number b) {
  return a != a || a > b ? a : b;
}

std::int64_t CountOf(const RunSummary& summary, SolveStatus status) {
  return summary.status_count[static_cast<std::size_t>(status)];
}

/// "2 converged, 1 stalled"
std::string CountsOf(const RunSummary& summary, bool failures_only) {
  std::string text;
  for (std::size_t i = 0; i < kStatuses.size(); ++i) {
    if (summary.status_count[i] == 0 || (failures_only && kStatuses[i].is_as_asked)) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", summary.status_count[i], kStatuses[i].word);
  }
  return text;
}

/// "2", or "1 to 2" where the steps differ.
std::string Range(std::int64_t least, std::int64_t most) {
  return least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most);
}

std::string Plural(std::int64_t count, const char* noun) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); }

/// Two columns: what, and how much.
class Table {
 public:
  void Add(std::string what, std::string how_much) { rows_.emplace_back(std::move(what), std::move(how_much)); }

  std::string Format() const {
    std::size_t width = 0;
    for (const auto& row : rows_) width = std::max(width, row.first.size());
    std::string text;
    for (const auto& [what, how_much] : rows_) text += fmt::format("  {:<{}}  {}\n", what, width, how_much);
    return text;
  }

 private:
  std::vector<std::pair<std::string, std::string>> rows_;
};

void AddRun(const RunSummary& s, Table* table) {
  table->Add("scene", s.adapter.empty() ? s.scene : fmt::format("{}, on {}", s.scene, s.adapter));
  table->Add("solver", fmt::format("{}, {}x{} {}, {}", s.solver, s.subdomains_x, s.subdomains_y,
                                   s.subdomains_x * s.subdomains_y == 1 ? "subdomain" : "subdomains", Plural(s.ranks, "rank")));
  table->Add("criterion", s.criterion);
  const std::string counts = s.steps > 0 ? ": " + CountsOf(s, false) : "";
  table->Add("steps", fmt::format("{} of {}, {:.6g} s simulated{}", s.steps, s.steps_asked, s.last.time, counts));
  const SolveReport& solve = s.last.solve;
  std::string last = fmt::format("{} free {}, {} ({} active)", s.last.bodies, s.last.bodies == 1 ? "body" : "bodies",
                                 Plural(solve.contacts, "contact"), solve.active);
  if (solve.interface_bodies > 0) {
    last += fmt::format(", {} on the interface (multiplicity up to {})", solve.interface_bodies, solve.max_multiplicity);
  }
  if (s.steps > 0) table->Add("last step", last);
}

void AddConvergence(const RunSummary& s, Table* table) {
  const auto count = static_cast<double>(s.steps);
  const SolveReport &sum = s.sum.solve, &most = s.most.solve;
  table->Add("iterations",
             fmt::format("mean {:.1f}, max {} ({:.1f} sweeps a step)", static_cast<double>(sum.iterations) / count,
                         most.iterations, static_cast<double>(sum.sweeps) / count));
  table->Add("residual", fmt::format("nat: mean {:.2e}, max {:.2e}; nat_max: max {:.2e}", sum.residuals.nat / count,
                                     most.residuals.nat, most.residuals.nat_max));
  const double mean = s.sum.mean_interpenetration / count, max = s.most.max_interpenetration, radius = s.last.mean_radius;
  std::string in_radii;
  if (radius > 0.0) in_radii = fmt::format(" = {:.2e} and {:.2e} mean radii", mean / radius, max / radius);
  table->Add("interpenetration", fmt::format("mean {:.3e} m, max {:.3e} m{}", mean, max, in_radii));
  if (s.subdomains_x * s.subdomains_y > 1)
    table->Add("interface jump", fmt::format("max {:.2e} m/s (rms over copies)", most.residuals.interface_jump));
  if (s.sum.injected_energy > 0.0)
    table->Add("injected energy", fmt::format("{:.3e} J at most, by gap feedback", s.sum.injected_energy));
}

void AddCost(const RunSummary& s, Table* table) {
  const StepReport& sum = s.sum;
  const double other = sum.seconds_total - sum.seconds_detect - sum.seconds_solve - sum.seconds_communicate;
  table->Add("seconds",
             fmt::format("{:.3f}: detect {:.3f}, solve {:.3f}, communicate {:.3f}, other {:.3f}, outside steps {:.3f}",
                         s.seconds_wall, sum.seconds_detect, sum.seconds_solve, sum.seconds_communicate, std::max(0.0, other),
                         std::max(0.0, s.seconds_wall - sum.seconds_total)));
  if (sum.solve.factorisations > 0) {
    table->Add("interface", fmt::format("{} with {} and {}, {:.3f} s", Plural(sum.solve.interface_updates, "update"),
                                        Plural(sum.solve.factorisations, "factorisation"),
                                        Plural(sum.solve.cg_iterations, "CG iteration"), sum.solve.seconds_interface));
  }
  const SolveReport &least = s.least.solve, &most = s.most.solve;
  table->Add("model", fmt::format("unknowns: {} per contact, {} per body; bytes swept: {} per contact, {} per body",
                                  Range(least.unknowns_per_contact, most.unknowns_per_contact),
                                  Range(least.unknowns_per_body, most.unknowns_per_body),
                                  Range(least.bytes_per_contact, most.bytes_per_contact),
                                  Range(least.bytes_per_body, most.bytes_per_body)));
  if (s.ranks > 1) {
    table->Add(
        "communication",
        fmt::format("{} ({:.3g} MB), {}, {}", Plural(sum.messages, "message"), static_cast<double>(sum.message_bytes) / 1e6,
                    Plural(sum.collectives, "collective call"), Plural(sum.migrated_bodies, "migration")));
  }
}

/// One line each, however many steps it was.
std::string Warnings(const RunSummary& s) {
  std::string text;
  if (s.not_converged() > 0) {
    const SolveReport& first = s.first_not_converged.solve;
    text += fmt::format("NOT CONVERGED: {} of {} ({}); first: step {}, nat {:.2e}, worst contact of bodies {} and {}{}\n",
                        s.not_converged(), Plural(s.steps, "step"), CountsOf(s, true), s.first_not_converged.step,
                        first.residuals.nat, first.residuals.worst_body_a, first.residuals.worst_body_b,
                        first.reason.empty() ? "" : ": " + first.reason);
  }
  if (CountOf(s, SolveStatus::kIncomplete) > 0) {
    text += fmt::format("INCOMPLETE: in {} the subdomains were solved alone (nat up to {:.2e}), as this solver does\n",
                        Plural(CountOf(s, SolveStatus::kIncomplete), "step"), s.most.solve.residuals.nat);
  }
  if (CountOf(s, SolveStatus::kFixed) > 0) {
    text += fmt::format("FIXED: in {} as many iterations were made as asked for, whatever the residual (nat up to {:.2e})\n",
                        Plural(CountOf(s, SolveStatus::kFixed), "step"), s.most.solve.residuals.nat);
  }
  if (s.steps_beyond_reach > 0) {
    text += fmt::format(
        "FAST BODIES: in {} a body moved further than contacts were looked for, some may have been missed: choose "
        "normal_law = \"impact\", or a smaller time step\n",
        Plural(s.steps_beyond_reach, "step"));
  }
  if (s.uneven_steps > 0) {
    text += fmt::format(
        "UNEVEN: in {} the criterion was met while a contact was off by more than half the free-fall or approach speed "
        "(nat_max up to {:.2g}): choose criterion nat_max where light bodies carry heavy ones\n",
        Plural(s.uneven_steps, "step"), s.most.solve.residuals.nat_max);
  }
  if (s.sum.solve.painleve_contacts > 0) {
    text += fmt::format("PAINLEVE: {} without a unique solution (friction too large for the shapes)\n",
                        Plural(s.sum.solve.painleve_contacts, "local problem"));
  }
  return text;
}

}  // namespace

void RunSummary::Add(const StepReport& step) {
  if (steps++ == 0) least = most = step;
  const auto gather = [](const Figure& figure, auto& sum_of, auto& least_of, auto& most_of, const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      if (figure.unit == std::string_view("id")) return;
      sum_of += value;
      least_of = std::min(least_of, value);
      most_of = WorstOf(most_of, value);
    }
  };
  ForEachFigure(gather, sum, least, most, step);
  last = step;
  if (!IsAsAsked(step.solve.status) && not_converged() == 0) first_not_converged = step;
  ++status_count[static_cast<std::size_t>(step.solve.status)];
  if (step.beyond_reach > 0) ++steps_beyond_reach;
  if (step.solve.status == SolveStatus::kConverged && step.solve.residuals.nat_max > 0.5) ++uneven_steps;
}

std::int64_t RunSummary::not_converged() const {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < kStatuses.size(); ++i) count += kStatuses[i].is_as_asked ? 0 : status_count[i];
  return count;
}

std::string FormatSummary(const RunSummary& summary) {
  Table table;
  AddRun(summary, &table);
  if (summary.steps > 0) {
    AddConvergence(summary, &table);
    AddCost(summary, &table);
  }
  if (!summary.output.empty()) table.Add("results", summary.output);
  return table.Format() + Warnings(summary);
}

}  // namespace nscdd
