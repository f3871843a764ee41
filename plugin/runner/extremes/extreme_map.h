// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "extremes/extreme_case.h"
#include "nscdd/host/solver_registry.h"

namespace nscdd {

/// A solver as the map shows it: one column.
struct SolverColumn {
  std::string name;  ///< for instance nscdd/anderson
  std::string solver;
  std::vector<std::pair<std::string, std::string>> options;
};

/// A column per solver of the plugins, or one per acceleration where a solver has several. `wanted` (empty: all) keeps the
/// columns whose name or solver is in it; throws Error on a word that fits none.
std::vector<SolverColumn> MakeColumns(const SolverRegistry& registry, const std::vector<std::string>& wanted);

enum class Verdict {
  kHolds,    ///< the error is within the bound that the tolerance promises
  kLimit,    ///< it is not, and a status or a sentence says so
  kRefused,  ///< the plugin refused the case with a sentence
  kSilent,   ///< SILENT MISS: converged without a word, and wrong
  kBroken,   ///< not a number, momentum or energy out of nothing
  kNone,     ///< not a case for this solver
};

/// What a solver made of a case; worst of all steps.
struct Outcome {
  Verdict verdict = Verdict::kNone;
  std::string status;     ///< of the step that ended worst
  std::string sentence;   ///< why it stopped, and what the host should know
  double error = 0.0;     ///< [-] largest of |dV_x|, |dV_y|, R |dspin| of free bodies at the end, over the scale
  double bound = 0.0;     ///< [-] what tolerance, number of contacts and rounding of the coordinates allow
  double momentum = 0.0;  ///< [-] of a step: | sum m (V - V_f) - impulses of the walls | over the sum of momenta and impulses
  double energy = 0.0;    ///< [-] kinetic energy above that of the free velocities, over the scale's (no law of restitution)
  double nat = 0.0;
  double nat_max = 0.0;
  std::int64_t iterations = 0;
  std::int64_t contacts = 0;
};

/// One case with every column: a row of the map. `max_iterations`: of all solvers but newton, which has its own.
std::vector<Outcome> RunCase(const ExtremeCase& extreme_case, const std::vector<SolverColumn>& columns,
                             const SolverRegistry& registry, int max_iterations);

/// The measured map: a row per case, a column per solver.
struct ExtremeMap {
  std::vector<ExtremeCase> cases;
  std::vector<SolverColumn> columns;
  std::vector<std::vector<Outcome>> outcomes;
};

/// One letter: '.' holds, I incomplete, L iteration limit, S stalled, D diverged, W warned, R refused, ! silent miss, X broken,
/// ' ' none.
char MarkOf(const Outcome& outcome);

/// A line of the table: name, then mark, decade of the error and iterations of each column.
std::string FormatHead(const ExtremeMap& map);
std::string FormatRow(const ExtremeMap& map, std::size_t row);
/// How many hold, per column; every silent miss and break with its sentence.
std::string FormatSummary(const ExtremeMap& map);
/// Cells that must not be: silent misses and broken ones.
int CountFailures(const ExtremeMap& map);

/// All that was measured, as extremes.csv holds it.
std::string FormatCsv(const ExtremeMap& map);
/// Draws the map: colour says the error, the letter how the solver ended. PNG or SVG.
void DrawMap(const ExtremeMap& map, const std::filesystem::path& file);

}  // namespace nscdd
