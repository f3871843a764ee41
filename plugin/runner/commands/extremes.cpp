// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.h"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>

#include "extremes/extreme_map.h"
#include "nscdd/error.h"
#include "results/written_file.h"

namespace nscdd {
int Extremes(const ExtremesRequest& request) {
  SolverRegistry registry;
  registry.Add(FindPlugin(request.plugin));
  ExtremeMap map{ReadExtremeCases(), MakeColumns(registry, request.solvers), {}};
  if (request.quick) std::erase_if(map.cases, [](const ExtremeCase& c) { return !c.quick; });
  std::error_code failure;
  std::filesystem::create_directories(request.out, failure);
  if (failure) throw Error(fmt::format("--out: cannot make the folder '{}': {}", request.out.string(), failure.message()));
  fmt::print("{} cases, {} solvers; a cell: how it ended, decade of the error, iterations\n{}", map.cases.size(),
             map.columns.size(), FormatHead(map));
  for (std::size_t row = 0; row < map.cases.size(); ++row) {
    map.outcomes.push_back(RunCase(map.cases[row], map.columns, registry, request.quick ? 2000 : 20000));
    fmt::print("{}", FormatRow(map, row));
    std::fflush(stdout);
  }
  ReplaceText(request.out / "extremes.csv", FormatCsv(map));
  DrawMap(map, request.out / "extremes.png");
  fmt::print(
      "{}. holds   I incomplete   L iteration limit   S stalled   D diverged   W warned   R refused   ! silent miss   X "
      "broken\n"
      "results  {}\n",
      FormatSummary(map), (request.out / "extremes.png").string());
  return CountFailures(map) == 0 ? 0 : 1;
}

}  // namespace nscdd
