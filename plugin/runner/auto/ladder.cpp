// SPDX-License-Identifier: Apache-2.0
#include "auto/ladder.h"

#include <fmt/format.h>

#include <algorithm>

#include "nscdd/grid_size.h"

namespace nscdd {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kOneSubdomain = "1x1";

bool Has(const SolverRegistry& registry, const std::string& solver, const std::string& option) {
  for (const auto& entry : registry.entries()) {
    if (solver == entry.info->name) return FindOption(*entry.info, option) != nullptr;
  }
  return false;
}

std::string GridOf(const Setting& setting) { return setting.Option("subdomains", kOneSubdomain); }

/// Index of the entry to begin with.
std::size_t First(const AutoSettings& wish, const std::vector<FrontEntry>& usable) {
  if (wish.interpenetration) {
    const auto good = std::find_if(usable.begin(), usable.end(),
                                   [&](const FrontEntry& e) { return e.interpenetration <= *wish.interpenetration; });
    return good == usable.end() ? usable.size() - 1 : static_cast<std::size_t>(good - usable.begin());
  }
  std::size_t first = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (wish.budget && usable[i].seconds <= *wish.budget) first = i;
  }
  return first;
}

}  // namespace

std::vector<Setting> SafeLadder(const std::string& grid, const SolverRegistry& registry) {
  const bool one = grid == kOneSubdomain;
  const std::string solver = one ? "nscd" : "nscdd";
  std::vector<Setting> rungs;
  const auto accelerated = [&](const std::string& name, Options options) {
    if (!one) options.emplace_back("subdomains", grid);
    if (Has(registry, solver, "acceleration")) options.emplace_back("acceleration", "anderson");
    rungs.push_back({fmt::format("{} {}", solver, name), solver, std::move(options)});
  };
  if (one) {
    accelerated("20 its", {{"tolerance", "0"}, {"max_iterations", "20"}, {"test_every", "20"}});
  } else {
    Options options = {
        {"subdomains", grid}, {"lambda", "100"}, {"tolerance", "0"}, {"max_iterations", "20"}, {"test_every", "20"}};
    rungs.push_back({"iea", "iea", options});
    options.emplace_back("closing_updates", "20");
    rungs.push_back({"iea hybrid", "iea", options});
  }
  for (const std::string tolerance : {"1e-3", "1e-4", "1e-5"}) accelerated("nat " + tolerance, {{"tolerance", tolerance}});
  if (one) rungs.push_back({"newton nat 1e-6", "newton", {{"tolerance", "1e-6"}}});
  std::vector<std::string> unused;
  return KnownSettings(std::move(rungs), registry, &unused);
}

Ladder MakeLadder(const AutoSettings& wish, const std::string& grid, int ranks, const std::vector<FrontEntry>& front,
                  const std::string& front_file, const SolverRegistry& registry) {
  std::vector<FrontEntry> usable;
  for (const FrontEntry& entry : front) {
    const std::string own = GridOf(entry.setting);
    std::vector<std::string> unused;
    const bool fits = (grid.empty() || own == grid) && ParseGrid(own).value_or(GridSize{}).cells() >= ranks &&
                      !KnownSettings({entry.setting}, registry, &unused).empty();
    if (fits) usable.push_back(entry);
  }
  if (usable.empty()) return {SafeLadder(grid.empty() ? kOneSubdomain : grid, registry), "safe defaults"};
  const std::size_t first = First(wish, usable);
  const std::string chosen = GridOf(usable[first].setting);
  Ladder ladder{{}, front_file};
  for (std::size_t i = first; i < usable.size(); ++i) {
    if (GridOf(usable[i].setting) == chosen) ladder.rungs.push_back(usable[i].setting);
  }
  for (Setting& rung : SafeLadder(chosen, registry)) {
    if (rung.Option("tolerance") != "0") ladder.rungs.push_back(std::move(rung));
  }
  return ladder;
}

}  // namespace nscdd
