// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "nscdd/grid_size.h"
#include "nscdd/options.h"

namespace nscdd {

/// Everything that the options of a solver set.
struct SolverSettings {
  SteppingOptions stepping;
  AlgorithmOptions algorithm;
};

/// One of Option::words.
struct WordIndex {
  std::size_t index = 0;
};

/// A value of an option; which alternative it is says the kind of the option.
using OptionValue = std::variant<bool, int, double, WordIndex, GridSize>;

/// Inclusive limits of a number, or of the cells of a grid; `excluded` says that they themselves are refused.
struct Limits {
  double least = -1e308;
  double most = 1e308;
  bool excluded = false;
};

/// An option: the only place where its name, unit, limits, words and help are written. The default is the member's own.
struct Option {
  std::string name;
  std::string unit;  ///< "-" when dimensionless
  Limits limits;
  std::vector<std::string> words;  ///< of a choice, in the order of the enumerators
  std::string help;                ///< one line
  std::function<OptionValue(const SolverSettings&)> get;
  std::function<void(const OptionValue&, SolverSettings*)> set;  ///< does not check; `value` must be of the option's kind
};

/// Whether a value of the option's kind is within its limits.
bool Allows(const Option& option, const OptionValue& value);
/// What a value must be, for sentences: "a finite number >= 0", "one of nat, quad". `value` is any of the option's kind.
std::string MustBe(const Option& option, const OptionValue& value);
/// true, 12, 1e-4, nat, 4x2.
std::string TextOf(const Option& option, const OptionValue& value);

/// A solver: a name, the alternative of AlgorithmOptions that it stands for, and its options.
struct SolverEntry {
  std::string name;
  std::string summary;  ///< one line
  SolverSettings defaults;
  std::vector<Option> options;
};

/// All solvers. Constant; made at the first call.
const std::vector<SolverEntry>& SolverTable();

/// Throws Error, naming the option, its value and what it must be, unless the solver that settings.algorithm stands for takes
/// them.
void CheckSettings(const SolverSettings& settings);

}  // namespace nscdd
