// SPDX-License-Identifier: Apache-2.0
#include "solver_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "nscdd/error.h"
#include "option_text.h"

namespace nscdd {
namespace {

/// Options of every solver, then the groups.
template <class... Groups>
std::vector<Option> Join(Groups... groups) {
  std::vector<Option> all = CommonOptions();
  (all.insert(all.end(), std::make_move_iterator(groups.begin()), std::make_move_iterator(groups.end())), ...);
  return all;
}

std::vector<SolverEntry> MakeTable() {
  return {
      {"nscd",
       "NonSmooth Contact Dynamics: nonlinear Gauss-Seidel sweeps over all contacts, one subdomain",
       {{}, NscdOptions{}},
       Join(AccelerationTable())},
      {"nscdd",
       "NSCD with domain decomposition: sweeps in each subdomain, then the mean velocity of each interface body",
       {{}, NscddOptions{}},
       Join(PartitionOptionTable(), StageOptions(), AccelerationTable())},
      {"fea",
       "fully enriched algorithm: nscdd with the augmented interface problem (lambda) after every sweep",
       {{}, FeaOptions{}},
       Join(PartitionOptionTable(), StageOptions(), InterfaceOptions(), AccelerationTable(), FeaOptionTable())},
      {"rea",
       "relaxed enriched algorithm: iterates until the interface agrees, then solves each subdomain by itself",
       {{}, ReaOptions{}},
       Join(PartitionOptionTable(), StageOptions(), InterfaceOptions(), ReaOptionTable())},
      {"iea",
       "incomplete enriched algorithm: one augmented interface problem a step, then each subdomain by itself",
       {{}, IeaOptions{}},
       Join(PartitionOptionTable(), InterfaceOptions(), IeaOptionTable())},
      {"newton",
       "high accuracy with friction: interior point iterations, one sparse factorisation each, and plain sweeps beside them; "
       "one subdomain",
       {{}, NewtonOptions{}},
       Join(NewtonOptionTable())},
  };
}

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
  const std::string nearest = Nearest(name, names);
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
  std::vector<std::vector<std::string>> defaults;
  std::vector<std::vector<nscdd_option>> options;
  std::vector<nscdd_solver_info> solvers;

  InfoMirror() {
    for (const SolverEntry& solver : SolverTable()) {
      std::vector<std::string>& texts = defaults.emplace_back();
      for (const Option& option : solver.options) texts.push_back(option.print(solver.defaults));
    }
    for (std::size_t s = 0; s < SolverTable().size(); ++s) AddSolver(SolverTable()[s], defaults[s]);
    for (std::size_t s = 0; s < SolverTable().size(); ++s) solvers[s].options = options[s].data();
  }

  void AddSolver(const SolverEntry& solver, const std::vector<std::string>& texts) {
    std::vector<nscdd_option>& list = options.emplace_back();
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const Option& o = solver.options[i];
      list.push_back({o.name.c_str(), o.type, 0, texts[i].c_str(), o.unit.c_str(), o.choices.c_str(), o.help.c_str()});
    }
    solvers.push_back({solver.name.c_str(), solver.summary.c_str(), list.size(), nullptr});
  }
};

}  // namespace

const std::vector<SolverEntry>& SolverTable() {
  static const std::vector<SolverEntry> table = MakeTable();
  return table;
}

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
    option->set(value, &settings);
  }
  return settings;
}

std::span<const nscdd_solver_info> SolverInfos() {
  static const InfoMirror mirror;
  return mirror.solvers;
}

}  // namespace nscdd
