// SPDX-License-Identifier: Apache-2.0
#include "results/run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace nscdd {
namespace {

constexpr std::array kStatusNames = {"converged", "iteration_limit", "stalled", "incomplete", "fixed", "diverged"};
constexpr std::size_t kIncomplete = 3, kFixed = 4;  // what was asked for: no failure, and no convergence

bool IsFailure(std::size_t status) { return status != 0 && status != kIncomplete && status != kFixed; }

/// Position in kStatusNames; an unknown word counts as diverged, so that it is not taken for success.
std::size_t StatusIndex(const std::string& status) {
  const auto found = std::find(kStatusNames.begin(), kStatusNames.end(), status);
  return found == kStatusNames.end() ? kStatusNames.size() - 1 : static_cast<std::size_t>(found - kStatusNames.begin());
}

/// Larger of the two; not a number if one of them is not.
double WorstOf(double a, double b) { return std::isnan(a) || a > b ? a : b; }

std::string CountsOf(const RunSummary& summary, std::size_t first_status) {
  std::string text;
  for (std::size_t i = first_status; i < kStatusNames.size(); ++i) {
    if (summary.status_count[i] == 0 || (first_status > 0 && !IsFailure(i))) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", summary.status_count[i], kStatusNames[i]);
  }
  return text;
}

/// "2", or "1 to 2" where the steps differ.
std::string Format(const CountRange& range) {
  return range.least == range.most ? fmt::format("{}", range.most) : fmt::format("{} to {}", range.least, range.most);
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
  const std::string counts = s.steps > 0 ? ": " + CountsOf(s, 0) : "";
  table->Add("steps", fmt::format("{} of {}, {:.6g} s simulated{}", s.steps, s.steps_asked, s.time, counts));
  std::string last = fmt::format("{} free {}, {} ({} active)", s.last.bodies, s.last.bodies == 1 ? "body" : "bodies",
                                 Plural(s.last.contacts, "contact"), s.last.active);
  if (s.last.interface_bodies > 0) {
    last += fmt::format(", {} on the interface (multiplicity up to {})", s.last.interface_bodies, s.last.max_multiplicity);
  }
  if (s.steps > 0) table->Add("last step", last);
}

void AddConvergence(const RunSummary& s, Table* table) {
  const auto count = static_cast<double>(s.steps);
  table->Add("iterations", fmt::format("mean {:.1f}, max {} ({:.1f} sweeps a step)", static_cast<double>(s.iterations) / count,
                                       s.max_iterations, static_cast<double>(s.sweeps) / count));
  table->Add("residual",
             fmt::format("nat: mean {:.2e}, max {:.2e}; nat_max: max {:.2e}", s.nat / count, s.max_nat, s.max_nat_max));
  const double radius = s.last.mean_radius;
  std::string in_radii;
  if (radius > 0.0) {
    in_radii = fmt::format(" = {:.2e} and {:.2e} mean radii", s.mean_interpenetration / count / radius,
                           s.max_interpenetration / radius);
  }
  table->Add("interpenetration",
             fmt::format("mean {:.3e} m, max {:.3e} m{}", s.mean_interpenetration / count, s.max_interpenetration, in_radii));
  if (s.subdomains_x * s.subdomains_y > 1)
    table->Add("interface jump", fmt::format("max {:.2e} m/s (rms over copies)", s.max_jump));
  if (s.injected_energy > 0.0)
    table->Add("injected energy", fmt::format("{:.3e} J at most, by gap feedback", s.injected_energy));
}

void AddCost(const RunSummary& s, Table* table) {
  const double other = s.seconds_steps - s.seconds_detect - s.seconds_solve - s.seconds_communicate;
  table->Add("seconds",
             fmt::format("{:.3f}: detect {:.3f}, solve {:.3f}, communicate {:.3f}, other {:.3f}, outside steps {:.3f}",
                         s.seconds_wall, s.seconds_detect, s.seconds_solve, s.seconds_communicate, std::max(0.0, other),
                         std::max(0.0, s.seconds_wall - s.seconds_steps)));
  if (s.factorisations > 0) {
    table->Add("interface", fmt::format("{} with {} and {}, {:.3f} s", Plural(s.interface_updates, "update"),
                                        Plural(s.factorisations, "factorisation"), Plural(s.cg_iterations, "CG iteration"),
                                        s.seconds_interface));
  }
  table->Add("model", fmt::format("unknowns: {} per contact, {} per body; bytes swept: {} per contact, {} per body",
                                  Format(s.unknowns_per_contact), Format(s.unknowns_per_body), Format(s.bytes_per_contact),
                                  Format(s.bytes_per_body)));
  if (s.ranks > 1) {
    table->Add("communication",
               fmt::format("{} ({:.3g} MB), {}, {}", Plural(s.messages, "message"), static_cast<double>(s.message_bytes) / 1e6,
                           Plural(s.collectives, "collective call"), Plural(s.migrated_bodies, "migration")));
  }
}

/// One line each, however many steps it was.
std::string Warnings(const RunSummary& s) {
  std::string text;
  if (s.not_converged() > 0) {
    const StepRow& first = s.first_not_converged;
    text += fmt::format("NOT CONVERGED: {} of {} ({}); first: step {}, nat {:.2e}, worst contact of bodies {} and {}{}\n",
                        s.not_converged(), Plural(s.steps, "step"), CountsOf(s, 1), first.step, first.nat, first.worst_body_a,
                        first.worst_body_b, first.reason.empty() ? "" : ": " + first.reason);
  }
  if (s.status_count[kIncomplete] > 0) {
    text += fmt::format("INCOMPLETE: in {} the subdomains were solved alone (nat up to {:.2e}), as this solver does\n",
                        Plural(s.status_count[kIncomplete], "step"), s.max_nat);
  }
  if (s.status_count[kFixed] > 0) {
    text += fmt::format("FIXED: in {} as many iterations were made as asked for, whatever the residual (nat up to {:.2e})\n",
                        Plural(s.status_count[kFixed], "step"), s.max_nat);
  }
  if (s.steps_beyond_alert > 0) {
    text += fmt::format(
        "FAST BODIES: in {} a body moved by more than the alert distance or the mean radius, contacts may have been missed: "
        "choose a smaller time step, or up to a radius a larger alert distance\n",
        Plural(s.steps_beyond_alert, "step"));
  }
  if (s.uneven_steps > 0) {
    text += fmt::format(
        "UNEVEN: in {} the criterion was met while a contact was off by more than half the free-fall or approach speed "
        "(nat_max up to {:.2g}): choose criterion nat_max where light bodies carry heavy ones\n",
        Plural(s.uneven_steps, "step"), s.max_nat_max);
  }
  if (s.painleve_contacts > 0) {
    text += fmt::format("PAINLEVE: {} without a unique solution (friction too large for the shapes)\n",
                        Plural(s.painleve_contacts, "local problem"));
  }
  return text;
}

}  // namespace

void RunSummary::Add(const StepRow& row) {
  const auto widen = [&](CountRange RunSummary::*range, std::int64_t count) {
    CountRange& r = this->*range;
    r = steps == 0 ? CountRange{count, count} : CountRange{std::min(r.least, count), std::max(r.most, count)};
  };
  widen(&RunSummary::unknowns_per_contact, row.unknowns_per_contact);
  widen(&RunSummary::unknowns_per_body, row.unknowns_per_body);
  widen(&RunSummary::bytes_per_contact, row.bytes_per_contact);
  widen(&RunSummary::bytes_per_body, row.bytes_per_body);
  ++steps;
  time = row.time;
  last = row;
  const std::size_t status = StatusIndex(row.status);
  if (IsFailure(status) && not_converged() == 0) first_not_converged = row;
  ++status_count[status];
  iterations += row.iterations;
  max_iterations = std::max(max_iterations, row.iterations);
  sweeps += row.sweeps;
  nat += row.nat;
  max_nat = WorstOf(max_nat, row.nat);
  max_nat_max = WorstOf(max_nat_max, row.nat_max);
  mean_interpenetration += row.mean_interpenetration;
  max_interpenetration = WorstOf(max_interpenetration, row.max_interpenetration);
  max_jump = WorstOf(max_jump, row.interface_jump);
  injected_energy += row.injected_energy;
  // Beyond a radius a thin wall may lie behind the body when contacts are sought, whatever the alert distance.
  if (row.max_drift > std::min(row.alert_distance, row.mean_radius)) ++steps_beyond_alert;
  if (row.status == "converged" && row.nat_max > 0.5) ++uneven_steps;
  painleve_contacts += row.painleve_contacts;
  migrated_bodies += row.migrated_bodies;
  messages += row.messages;
  message_bytes += row.message_bytes;
  collectives += row.collectives;
  seconds_detect += row.seconds_detect;
  seconds_solve += row.seconds_solve;
  seconds_communicate += row.seconds_communicate;
  seconds_steps += row.seconds_total;
  interface_updates += row.interface_updates;
  cg_iterations += row.cg_iterations;
  factorisations += row.factorisations;
  seconds_interface += row.seconds_interface;
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
