// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/communicator.h"
#include "problem/interface_map.h"

namespace nscdd {

/// Averages vectors that live on the interface copies: `dofs` numbers per copy, in the order of InterfaceMap::copies.
class CopyAverage {
 public:
  CopyAverage(const InterfaceMap& map, int dofs, Communicator* communicator);

  /// Each copy's numbers become the mean over the copies of its body, added in the order of their subdomains. One exchange
  /// among neighbours; collective among them.
  void Average(std::vector<double>* values);
  /// values -= their average: the projection on zero sums per body.
  void Project(std::vector<double>* values);

 private:
  void FillSlots(const std::vector<double>& values);

  const InterfaceMap& map_;
  int dofs_;
  Communicator* communicator_;
  std::vector<double> slots_;  // of every copy of every interface body
  std::vector<std::vector<double>> send_, receive_;
  std::vector<double> scratch_;
};

}  // namespace nscdd
