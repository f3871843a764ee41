// SPDX-License-Identifier: Apache-2.0
#include "solver_infos.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <type_traits>

#include "nscdd/error.h"
#include "option_text.h"
#include "text/nearest_name.h"

namespace nscdd {
namespace {

// nscdd_type counts the alternatives of OptionValue.
template <nscdd_type type>
using Alternative = std::variant_alternative_t<type, OptionValue>;
static_assert(std::is_same_v<Alternative<NSCDD_BOOL>, bool> && std::is_same_v<Alternative<NSCDD_INTEGER>, int> &&
              std::is_same_v<Alternative<NSCDD_REAL>, double> && std::is_same_v<Alternative<NSCDD_CHOICE>, WordIndex> &&
              std::is_same_v<Alternative<NSCDD_GRID>, GridSize> && std::variant_size_v<OptionValue> == 5);

template <class Entry>
std::vector<std::string> Names(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

template <class Entry>
const Entry* Find(const std::vector<Entry>& entries, std::string_view name) {
  const auto found = std::find_if(entries.begin(), entries.end(), [name](const Entry& e) { return e.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

std::string Suggestion(std::string_view name, const std::vector<std::string>& names) {
  const std::string nearest = NearestName(name, names);
  if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
  return fmt::format("it has {}", fmt::join(names, ", "));
}

[[noreturn]] void RefuseOption(const SolverEntry& solver, std::string_view name) {
  for (const SolverEntry& other : SolverTable()) {
    if (Find(other.options, name) == nullptr) continue;
    throw Error(fmt::format("solver '{}' has no option '{}', which belongs to solver '{}'; leave it out or take that solver",
                            solver.name, name, other.name));
  }
  throw Error(fmt::format("solver '{}' has no option '{}'; {}", solver.name, name.substr(0, 64),
                          Suggestion(name, Names(solver.options))));
}

// C structures that point into the (constant) table.
struct InfoMirror {
  std::vector<std::vector<std::string>> defaults, choices;
  std::vector<std::vector<nscdd_option>> options;
  std::vector<nscdd_solver_info> solvers;

  InfoMirror() {
    for (const SolverEntry& solver : SolverTable()) {
      std::vector<std::string>&texts = defaults.emplace_back(), &words = choices.emplace_back();
      for (const Option& option : solver.options) {
        texts.push_back(TextOf(option, option.get(solver.defaults)));
        words.push_back(fmt::format("{}", fmt::join(option.words, "|")));
      }
    }
    for (std::size_t s = 0; s < SolverTable().size(); ++s) AddSolver(SolverTable()[s], defaults[s], choices[s]);
    for (std::size_t s = 0; s < SolverTable().size(); ++s) solvers[s].options = options[s].data();
  }

  void AddSolver(const SolverEntry& solver, const std::vector<std::string>& texts, const std::vector<std::string>& words) {
    std::vector<nscdd_option>& list = options.emplace_back();
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const Option& o = solver.options[i];
      const auto type = static_cast<nscdd_type>(o.get(solver.defaults).index());
      list.push_back({o.name.c_str(), type, 0, texts[i].c_str(), o.unit.c_str(), words[i].c_str(), o.help.c_str()});
    }
    solvers.push_back({solver.name.c_str(), solver.summary.c_str(), list.size(), nullptr});
  }
};

}  // namespace

const SolverEntry& FindSolver(std::string_view name) {
  const SolverEntry* solver = Find(SolverTable(), name);
  if (solver != nullptr) return *solver;
  throw Error(fmt::format("there is no solver '{}'; {}", name.substr(0, 64), Suggestion(name, Names(SolverTable()))));
}

SolverSettings MakeSettings(const SolverEntry& solver, const OptionTexts& texts) {
  SolverSettings settings = solver.defaults;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto& [name, value] = texts[i];
    const Option* option = Find(solver.options, name);
    if (option == nullptr) RefuseOption(solver, name);
    const auto same = [&, i](const auto& earlier) { return earlier.first == texts[i].first; };
    if (std::any_of(texts.begin(), texts.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      throw Error(fmt::format("option '{}' is given twice; give it once", name));
    }
    option->set(ParseOption(*option, value, option->get(settings)), &settings);
  }
  CheckSettings(settings);
  return settings;
}

std::span<const nscdd_solver_info> SolverInfos() {
  static const InfoMirror mirror;
  return mirror.solvers;
}

}  // namespace nscdd
