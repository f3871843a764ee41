// SPDX-License-Identifier: Apache-2.0
#include "auto/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "nscdd/error.h"
#include "nscdd/grid_size.h"
#include "scene/csv_cells.h"

namespace nscdd {
namespace {

std::vector<std::string> Split(std::string_view text, Separator separator) {
  std::vector<std::string_view> fields;
  SplitLine(text, separator, &fields);
  return {fields.begin(), fields.end()};
}

/// A line of the file by the names of the header.
class Line {
 public:
  Line(const std::filesystem::path& file, int number, const std::vector<std::string>& header, const std::string& text)
      : where_(fmt::format("{}:{}", file.string(), number)), header_(header), cells_(Split(text, Separator::kComma)) {}

  const std::string& Text(const std::string& column) const {
    const auto at = std::find(header_.begin(), header_.end(), column) - header_.begin();
    if (static_cast<std::size_t>(at) < std::min(header_.size(), cells_.size())) return cells_[static_cast<std::size_t>(at)];
    throw Error(fmt::format("{}: has no column '{}'; measure the front anew with `nscdd tradeoff --store`, or remove the file",
                            where_, column));
  }

  double Number(const std::string& column) const {
    const std::string& text = Text(column);
    const std::optional<double> value = CsvNumber(text);
    if (value && *value >= 0.0) return *value;
    throw Error(fmt::format("{}: column '{}' is '{}', no number >= 0; measure the front anew with `nscdd tradeoff --store`",
                            where_, column, text));
  }

  void CheckGrid(const std::string& grid) const {
    if (ParseGrid(grid)) return;
    throw Error(fmt::format("{}: subdomains = {} is no grid such as 4x2; measure the front anew with `nscdd tradeoff --store`",
                            where_, grid));
  }

 private:
  std::string where_;
  const std::vector<std::string>& header_;
  std::vector<std::string> cells_;
};

FrontEntry EntryOf(const Line& line) {
  FrontEntry entry;
  entry.setting.name = line.Text("setting");
  entry.setting.solver = line.Text("solver");
  for (const std::string& option : Split(line.Text("options"), Separator::kSemicolon)) {
    const auto equals = option.find('=');
    if (equals != std::string::npos) entry.setting.options.emplace_back(option.substr(0, equals), option.substr(equals + 1));
  }
  line.CheckGrid(entry.setting.Option("subdomains", "1x1"));
  entry.seconds = line.Number("seconds");
  entry.nat = line.Number("nat");
  entry.interpenetration = line.Number("interpenetration_max");
  return entry;
}

}  // namespace

std::filesystem::path FrontFileOf(const std::filesystem::path& scene) {
  std::filesystem::path file = scene;
  return file.replace_extension(".front.csv");
}

std::vector<FrontEntry> ReadFront(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string text;
  if (!stream || !std::getline(stream, text)) {
    throw Error(
        fmt::format("{}: cannot be read or is empty; measure the front anew with `nscdd tradeoff --store`", file.string()));
  }
  const std::vector<std::string> header = Split(text, Separator::kComma);
  std::vector<FrontEntry> entries;
  for (int number = 2; std::getline(stream, text); ++number) {
    if (!text.empty()) entries.push_back(EntryOf(Line(file, number, header, text)));
  }
  return entries;
}

namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kOneSubdomain = "1x1";

bool Has(const SolverRegistry& registry, const std::string& solver, const std::string& option) {
  const auto& all = registry.entries();
  return std::any_of(all.begin(), all.end(),
                     [&](const auto& entry) { return solver == entry.info->name && FindOption(*entry.info, option); });
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
