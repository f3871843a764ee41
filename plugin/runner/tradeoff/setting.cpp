// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "nscdd/error.h"

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

}  // namespace

std::string Setting::Option(const std::string& key, const std::string& fallback) const {
  for (const auto& option : options) {
    if (option.first == key) return option.second;
  }
  return fallback;
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
  const nscdd_option* option = FindOption(*solver, "subdomains");
  return option == nullptr ? "1x1" : option->default_value;
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
