// SPDX-License-Identifier: Apache-2.0
#include "commands/extremes.h"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>

#include "extremes/extreme_map.h"
#include "nscdd/error.h"

namespace nscdd {
namespace {

std::vector<ExtremeCase> ChooseCases(bool quick) {
  std::vector<ExtremeCase> all;
  for (const auto& family : {StackCases(), LawCases(), ScaleCases(), JammedCases(), GeometryCases(), PartitionCases()}) {
    all.insert(all.end(), family.begin(), family.end());
  }
  if (quick) std::erase_if(all, [](const ExtremeCase& c) { return !c.quick; });
  return all;
}

}  // namespace

int Extremes(const ExtremesRequest& request) {
  SolverRegistry registry;
  registry.Add(FindPlugin(request.plugin));
  ExtremeMap map{ChooseCases(request.quick), MakeColumns(registry, request.solvers), {}};
  std::error_code failure;
  std::filesystem::create_directories(request.out, failure);
  if (failure) throw Error(fmt::format("--out: cannot make the folder '{}': {}", request.out.string(), failure.message()));
  const RunLimits limits{.max_iterations = request.quick ? 2000 : 20000};
  fmt::print("{} cases, {} solvers; a cell: how it ended, decade of the error, iterations\n{}", map.cases.size(),
             map.columns.size(), FormatHead(map));
  for (std::size_t row = 0; row < map.cases.size(); ++row) {
    map.outcomes.push_back(RunCase(map.cases[row], map.columns, registry, limits));
    fmt::print("{}", FormatRow(map, row));
    std::fflush(stdout);
  }
  WriteCsv(map, request.out / "extremes.csv");
  DrawMap(map, request.out / "extremes.png");
  fmt::print(
      "{}. holds   I incomplete   L iteration limit   S stalled   D diverged   W warned   R refused   ! silent miss   X "
      "broken\n"
      "results  {}\n",
      FormatSummary(map), (request.out / "extremes.png").string());
  return CountFailures(map) == 0 ? 0 : 1;
}

}  // namespace nscdd
