// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "nscdd/error.h"
#include "nscdd/option_table.h"

namespace nscdd {
namespace {

bool Inside(double value, const Limits& limits) {
  return limits.excluded ? value > limits.least && value < limits.most : value >= limits.least && value <= limits.most;
}

std::string Describe(const char* kind, const Limits& limits) {
  std::string text = kind;
  const bool below = limits.least > -1e308, above = limits.most < 1e308;
  if (below) text += fmt::format(" {} {}", limits.excluded ? ">" : ">=", limits.least);
  if (above) text += fmt::format("{} {} {}", below ? " and" : "", limits.excluded ? "<" : "<=", limits.most);
  return text;
}

struct Judge {
  const Option& option;
  bool operator()(bool) const { return true; }
  bool operator()(int value) const { return Inside(value, option.limits); }
  bool operator()(double value) const { return std::isfinite(value) && Inside(value, option.limits); }
  bool operator()(WordIndex word) const { return word.index < option.words.size(); }
  bool operator()(GridSize grid) const {
    return grid.nx >= 1 && grid.ny >= 1 && Inside(static_cast<double>(grid.cells()), option.limits);
  }
};

struct Demand {
  const Option& option;
  std::string operator()(bool) const { return "true or false"; }
  std::string operator()(int) const { return Describe("a whole number", option.limits); }
  std::string operator()(double) const { return Describe("a finite number", option.limits); }
  std::string operator()(WordIndex) const { return fmt::format("one of {}", fmt::join(option.words, ", ")); }
  std::string operator()(GridSize) const {
    return fmt::format("a grid such as 4x2 of at most {} subdomains", option.limits.most);
  }
};

struct Printer {
  const Option& option;
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(int value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(WordIndex word) const {
    return word.index < option.words.size() ? option.words[word.index] : fmt::format("number {}", word.index);
  }
  std::string operator()(GridSize grid) const { return fmt::format("{}x{}", grid.nx, grid.ny); }
};

void CheckCriterion(const NewtonOptions& o) {
  const Criterion criterion = o.stopping.criterion;
  if (criterion == Criterion::kNat || criterion == Criterion::kNatMax) return;
  throw Error(
      "option 'criterion' of solver 'newton' must be nat or nat_max: quad, maxm and qm16 measure what a sweep changes, and it "
      "has "
      "none");
}

}  // namespace

bool Allows(const Option& option, const OptionValue& value) { return std::visit(Judge{option}, value); }

std::string MustBe(const Option& option, const OptionValue& value) { return std::visit(Demand{option}, value); }

std::string TextOf(const Option& option, const OptionValue& value) { return std::visit(Printer{option}, value); }

void CheckSettings(const SolverSettings& settings) {
  const auto is_meant = [&](const SolverEntry& entry) {
    return entry.defaults.algorithm.index() == settings.algorithm.index();
  };
  const SolverEntry& solver = *std::find_if(SolverTable().begin(), SolverTable().end(), is_meant);
  for (const Option& option : solver.options) {
    const OptionValue value = option.get(settings);
    if (Allows(option, value)) continue;
    throw Error(fmt::format("option '{}' is '{}', must be {}", option.name, TextOf(option, value), MustBe(option, value)));
  }
  if (const auto* newton = std::get_if<NewtonOptions>(&settings.algorithm)) CheckCriterion(*newton);
}

}  // namespace nscdd
