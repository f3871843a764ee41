// SPDX-License-Identifier: Apache-2.0
#include "validator/check_list.h"

namespace nscdd {

std::vector<Check> AllChecks() {
  std::vector<Check> all = EntryChecks();
  for (const auto& group : {HandleChecks(), ProblemChecks(), RefusalChecks()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace nscdd
