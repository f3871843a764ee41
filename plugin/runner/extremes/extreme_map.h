// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "extremes/extreme_case.h"
#include "extremes/run_case.h"
#include "extremes/solver_column.h"

namespace nscdd {

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

/// Writes all that was measured. Throws Error when the file cannot be written.
void WriteCsv(const ExtremeMap& map, const std::filesystem::path& file);
/// Draws the map: colour says the error, the letter how the solver ended. PNG or SVG.
void DrawMap(const ExtremeMap& map, const std::filesystem::path& file);

}  // namespace nscdd
