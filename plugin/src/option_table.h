// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "nscdd/options.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// Everything that the options of one solver handle set.
struct SolverSettings {
  SteppingOptions stepping;
  AlgorithmOptions algorithm;
};

/// One option: the only place where its name, text, limits and member are written. The default is the member's own.
struct Option {
  std::string name;
  nscdd_type type;
  std::string unit;                                                 ///< "-" when dimensionless
  std::string choices;                                              ///< "a|b" of NSCDD_CHOICE
  std::string help;                                                 ///< one line
  std::function<void(std::string_view text, SolverSettings*)> set;  ///< throws Error
  std::function<std::string(const SolverSettings&)> print;
};

/// Options of every solver: stopping and stepping.
std::vector<Option> CommonOptions();
/// Options of solvers with subdomains: the grid; sweeps of stage 1; the augmented interface; what REA and IEA add.
std::vector<Option> PartitionOptionTable();
std::vector<Option> StageOptions();
/// acceleration, ...: of the iterations of nscd, nscdd and fea.
std::vector<Option> AccelerationTable();
std::vector<Option> InterfaceOptions();
std::vector<Option> FeaOptionTable();
std::vector<Option> ReaOptionTable();
std::vector<Option> IeaOptionTable();
std::vector<Option> NewtonOptionTable();

}  // namespace nscdd
