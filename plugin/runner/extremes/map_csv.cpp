// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "extremes/extreme_map.h"
#include "results/replaced_file.h"

namespace nscdd {
namespace {

const char* Name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHolds:
      return "holds";
    case Verdict::kLimit:
      return "limit";
    case Verdict::kRefused:
      return "refused";
    case Verdict::kSilent:
      return "silent_miss";
    case Verdict::kBroken:
      return "broken";
    case Verdict::kNone:
      break;
  }
  return "none";
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

void WriteCsv(const ExtremeMap& map, const std::filesystem::path& file) {
  std::string text =
      "family,case,subdomains,criterion,tolerance,solver,verdict,status,error,bound,momentum,energy,iterations,contacts,nat,"
      "nat_max,"
      "sentence\n";
  for (std::size_t i = 0; i < map.cases.size(); ++i) {
    const ExtremeCase& c = map.cases[i];
    for (std::size_t k = 0; k < map.columns.size(); ++k) {
      const Outcome& o = map.outcomes[i][k];
      if (o.verdict == Verdict::kNone) continue;
      text +=
          fmt::format("{},{},{},{},{},{},{},{},{:.3e},{:.1e},{:.1e},{:.1e},{},{},{:.3e},{:.3e},{}\n", c.family, Quoted(c.name),
                      c.subdomains, c.criterion, c.tolerance, map.columns[k].name, Name(o.verdict), o.status, o.error, o.bound,
                      o.momentum, o.energy, o.iterations, o.contacts, o.nat, o.nat_max, Quoted(o.sentence));
    }
  }
  ReplaceText(file, text);
}

}  // namespace nscdd
