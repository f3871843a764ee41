// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "interface/copy_average.h"
#include "nscdd/communicator.h"
#include "problem/interface_map.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Jump of one subdomain's copies, V_E - U, before they were glued.
struct JumpPart {
  double sum_squares = 0.0;  ///< |dv|^2 + (I / m) dw^2 [m^2/s^2]
  double copies = 0.0;
};

/// Stage 2 of NSCDD: the gluing operator X = sum A M~^-1 A^T is block diagonal, and  X dF = [V]  amounts to
///     U = mean over the copies of V_E,   dF_E = M~_E (V_E - U),   V_E := U      (sum_E dF_E = 0).
class Gluing {
 public:
  Gluing(const std::vector<SubdomainProblem>& problems, const InterfaceMap& map, Communicator* communicator);

  /// Computes U and the jumps, one part per problem; changes no state. Collective among neighbours.
  void Measure(const std::vector<SubdomainState>& states, std::vector<JumpPart>* jumps);
  /// The update, after Measure().
  void Glue(std::vector<SubdomainState>* states, InterfaceState* interface) const;
  /// Exchanges V_E of the copies with U, after Measure(): twice is nothing.
  void SwapMeans(std::vector<SubdomainState>* states);
  /// U of copy k of the map, Dofs numbers.
  const double* Mean(std::size_t k) const { return &mean_[dofs_ * k]; }

  /// V_E -= M~_E^-1 F_E on all copies (warm start; V_E is V_f + M~^-1 H r before).
  void SubtractImpulse(const InterfaceState& interface, std::vector<SubdomainState>* states) const;

 private:
  const std::vector<SubdomainProblem>& problems_;
  const InterfaceMap& map_;
  int dofs_;
  CopyAverage average_;
  std::vector<double> mean_;  // Dofs per copy
};

}  // namespace nscdd
