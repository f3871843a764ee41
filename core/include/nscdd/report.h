// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nscdd/figures.h"

namespace nscdd {

/// How a solve ended; words and meanings: kStatuses. Solvers whose residual need not fall from test to test (accelerated ones,
/// the augmented interface, newton) return the best tested iterate, the others the last one, or zero impulses if it diverged.
enum class SolveStatus { kConverged, kIterationLimit, kStalled, kDiverged, kIncomplete, kFixed };

/// A status in files and options.
struct StatusWord {
  const char* word;
  bool is_as_asked;  ///< the solve did what it was asked for
  const char* help;
};

/// By SolveStatus.
inline constexpr std::array kStatuses = {
    StatusWord{"converged", true,
               "the criterion is below its tolerance, load_error and power below their bounds, or there was no contact"},
    StatusWord{"iteration_limit", false, "max_iterations reached first"},
    StatusWord{
        "stalled", false,
        "no new minimum of what is tested for stall_iterations iterations (1000 where power is above 10), or no further step "
        "was possible"},
    StatusWord{
        "diverged", false,
        "the residual, or nat_max, is not finite, or above 1e6 times the first one and (nat_max: 1e6) above 1; rea, iea: no "
        "solution was found, power is above 10"},
    StatusWord{"incomplete", true,
               "an incomplete resolution (rea, iea) did all that it does; the criterion does not hold for the whole sample"},
    StatusWord{"fixed", true, "tolerance 0: it made the max_iterations iterations that it was asked for"},
};

/// Whether the solve did what it was asked for.
constexpr bool IsAsAsked(SolveStatus status) { return kStatuses[static_cast<std::size_t>(status)].is_as_asked; }

/// The word of a status in files and options.
constexpr const char* NameOf(SolveStatus status) { return kStatuses[static_cast<std::size_t>(status)].word; }

/// The status of that word; none if there is no such word.
constexpr std::optional<SolveStatus> FindStatus(std::string_view word) {
  for (std::size_t i = 0; i < kStatuses.size(); ++i) {
    if (kStatuses[i].word == word) return static_cast<SolveStatus>(i);
  }
  return std::nullopt;
}

#define NSCDD_NO_FIGURE(type, name, kind, unit, help)
#define NSCDD_FIGURE(type, name, kind, unit, help) type name{};

/// Residuals of the global problem at the end, and what the last tested sweep changed: the RESIDUAL lines of figures.h.
/// Definitions: residual.h.
struct Residuals {
  NSCDD_FIGURES(NSCDD_NO_FIGURE, NSCDD_NO_FIGURE, NSCDD_FIGURE)
};

/// Residuals at one test.
struct IterationRecord {
  int iteration = 0;
  double nat = 0.0;
  double nat_max = 0.0;
  double qm16 = 0.0;
  double interface_jump = 0.0;
};

/// What a solve did: the SOLVE lines of figures.h, residuals, and residuals at each test. The same on all ranks but for
/// seconds_*, which are this rank's.
struct SolveReport {
  NSCDD_FIGURES(NSCDD_NO_FIGURE, NSCDD_FIGURE, NSCDD_NO_FIGURE)
  Residuals residuals;
  std::vector<std::int64_t> squeezed;  ///< ids of bodies that have no room (power > 10), ascending, at most 64
  std::vector<IterationRecord> history;
};

/// What a time step did: the STEP lines of figures.h, and the solve: that of the displacements, and where contacts rebounded
/// that of the velocities, with the counts of both and the worse status. The same on all ranks but for seconds_*, which are
/// this rank's.
struct StepReport {
  NSCDD_FIGURES(NSCDD_FIGURE, NSCDD_NO_FIGURE, NSCDD_NO_FIGURE)
  SolveReport solve;
};

#undef NSCDD_FIGURE
#undef NSCDD_NO_FIGURE

/// Calls visit(figure, members...) for each figure in the order of figures.h, with its member of each report: StepReports, or
/// flat structures that have all figures as members of their own, as nscdd_report.
template <class Visit, class... Reports>
void ForEachFigure(Visit visit, Reports&... reports) {
  const auto solve = [](auto& r) -> auto& {
    if constexpr (requires { r.solve; })
      return r.solve;
    else
      return r;
  };
  const auto residuals = [&](auto& r) -> auto& {
    if constexpr (requires { r.solve; })
      return r.solve.residuals;
    else
      return r;
  };
#define NSCDD_VISIT_STEP(type, name, kind, unit, help) visit(Figure{#name, FigureKind::kind, unit, help}, reports.name...);
#define NSCDD_VISIT_SOLVE(type, name, kind, unit, help) \
  visit(Figure{#name, FigureKind::kind, unit, help}, solve(reports).name...);
#define NSCDD_VISIT_RESIDUAL(type, name, kind, unit, help) \
  visit(Figure{#name, FigureKind::kind, unit, help}, residuals(reports).name...);
  NSCDD_FIGURES(NSCDD_VISIT_STEP, NSCDD_VISIT_SOLVE, NSCDD_VISIT_RESIDUAL)
#undef NSCDD_VISIT_RESIDUAL
#undef NSCDD_VISIT_SOLVE
#undef NSCDD_VISIT_STEP
}

}  // namespace nscdd
