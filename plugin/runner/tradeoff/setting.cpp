// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "nscdd/error.h"
#include "scene/table_reader.h"
#include "scene/toml_file.h"

namespace nscdd {
namespace {

const nscdd_solver_info* FindSolver(const SolverRegistry& registry, const std::string& name) {
  for (const auto& entry : registry.entries()) {
    if (name == entry.info->name) return entry.info;
  }
  return nullptr;
}

/// What the plugin lacks for the setting; empty: nothing.
std::string Lack(const Setting& setting, const SolverRegistry& registry) {
  if (setting.is_box2d()) return "";
  const nscdd_solver_info* solver = FindSolver(registry, setting.solver);
  if (solver == nullptr) return fmt::format("the plugin has no solver '{}'", setting.solver);
  for (const auto& [key, value] : setting.options) {
    if (FindOption(*solver, key) == nullptr) return fmt::format("solver '{}' has no option '{}'", setting.solver, key);
  }
  return "";
}

bool IsNumberOrFlag(const std::string& text) {
  if (text == "true" || text == "false") return true;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// TOML wants digits on both sides of a point; ours have none but in the mantissa.
std::string TomlValue(const std::string& text) { return IsNumberOrFlag(text) ? text : fmt::format("\"{}\"", text); }

/// Lets the solver judge an option that it has; what no plugin has is left to KnownSettings.
void CheckValue(const TableReader& table, const Setting& setting, const std::string& key, const std::string& value,
                const SolverRegistry& registry) {
  const nscdd_solver_info* solver = FindSolver(registry, setting.solver);
  if (solver == nullptr || FindOption(*solver, key) == nullptr) return;
  try {
    registry.CheckOption(setting.solver, key, value);
  } catch (const Error& e) {
    table.Refuse(key, fmt::format("does not suit: {}", e.what()));
  }
}

}  // namespace

std::string Setting::Option(const std::string& key, const std::string& fallback) const {
  for (const auto& option : options) {
    if (option.first == key) return option.second;
  }
  return fallback;
}

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

std::vector<Setting> KnownSettings(std::vector<Setting> settings, const SolverRegistry& registry,
                                   std::vector<std::string>* notices) {
  std::vector<Setting> known;
  std::vector<std::pair<std::string, int>> lacks;
  for (Setting& setting : settings) {
    const nscdd_solver_info* solver = FindSolver(registry, setting.solver);
    if (solver != nullptr && FindOption(*solver, "acceleration") == nullptr) {
      std::erase(setting.options, std::pair<std::string, std::string>{"acceleration", "none"});  // it has no other way
    }
    const std::string lack = Lack(setting, registry);
    if (lack.empty()) {
      known.push_back(std::move(setting));
      continue;
    }
    const auto same = std::find_if(lacks.begin(), lacks.end(), [&](const auto& l) { return l.first == lack; });
    if (same == lacks.end()) {
      lacks.emplace_back(lack, 1);
    } else {
      ++same->second;
    }
  }
  for (const auto& [lack, count] : lacks) {
    notices->push_back(fmt::format("left out {} setting{}: {}", count, count == 1 ? "" : "s", lack));
  }
  return known;
}

std::string GridOf(const Setting& setting, const SolverRegistry& registry) {
  const std::string own = setting.Option("subdomains");
  const nscdd_solver_info* solver = FindSolver(registry, setting.solver);
  if (!own.empty() || solver == nullptr) return own.empty() ? "1x1" : own;
  const nscdd_option* grid = FindOption(*solver, "subdomains");
  return grid == nullptr ? "1x1" : grid->default_value;
}

std::string SolverSection(const Setting& setting) {
  std::string text = fmt::format("[solver]\nname = \"{}\"\n", setting.solver);
  for (const auto& [key, value] : setting.options) text += fmt::format("{} = {}\n", key, TomlValue(value));
  if (setting.substeps > 1) {
    text += fmt::format("# and in [time]: divide dt by {0}, multiply steps by {0}\n", setting.substeps);
  }
  return text;
}

}  // namespace nscdd
