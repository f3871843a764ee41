// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "nscdd/error.h"
#include "scene/table_reader.h"
#include "scene/toml_file.h"
#include "tradeoff/setting.h"

namespace nscdd {

namespace {

/// Lets the solver judge an option that it has; what no plugin has is left to KnownSettings.
void CheckValue(const TableReader& table, const Setting& setting, const std::string& key, const std::string& value,
                const SolverRegistry& registry) {
  const auto is_meant = [&](const auto& entry) { return setting.solver == entry.info->name; };
  const auto at = std::find_if(registry.entries().begin(), registry.entries().end(), is_meant);
  if (at == registry.entries().end() || FindOption(*at->info, key) == nullptr) return;
  try {
    registry.CheckOption(setting.solver, key, value);
  } catch (const Error& e) {
    table.Refuse(key, fmt::format("does not suit: {}", e.what()));
  }
}

}  // namespace

std::vector<Setting> ReadSettings(const std::filesystem::path& file, const SolverRegistry& registry) {
  constexpr std::int64_t kMostSubsteps = 1000;
  const toml::table text = ParseTomlFile(file);
  TableReader root(text, "", file);
  std::vector<Setting> settings;
  for (TableReader& table : root.Tables("settings")) {
    Setting setting;
    setting.name = table.Text("name");
    setting.solver = table.Text("solver");
    setting.substeps = static_cast<int>(table.Integer("substeps", 1, 1, kMostSubsteps));
    const auto same = [&](const Setting& other) { return other.name == setting.name; };
    if (setting.name == kSceneSetting || std::any_of(settings.begin(), settings.end(), same)) {
      table.Refuse("name", fmt::format("is '{}' twice; give each setting its own", setting.name));
    }
    for (const auto& [key, node] : table.table()) {
      if (key.str() == "name" || key.str() == "solver" || key.str() == "substeps") continue;
      setting.options.emplace_back(std::string(key.str()), OptionText(table, key.str(), node));
      CheckValue(table, setting, setting.options.back().first, setting.options.back().second, registry);
    }
    settings.push_back(std::move(setting));
  }
  root.Finish();
  if (settings.empty())
    throw Error(fmt::format("{}: has no [[settings]]; write one with name, solver and options.", file.string()));
  return settings;
}

}  // namespace nscdd
