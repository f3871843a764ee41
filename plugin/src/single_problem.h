// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/contact_problem.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// A problem of the C interface, copied and checked.
struct SingleProblem {
  ContactProblem problem;
  std::vector<Vec2> warm;  ///< empty: cold start
};

/// Copies `source`; contacts go to the subdomains of `grid` over the box of their sites (a point on a cut goes to the upper
/// cell). Throws Error on null arrays, numbers out of range, and null sites when there are several subdomains.
SingleProblem CopyProblem(const nscdd_problem& source, const PartitionOptions& grid);

/// Writes the solution into the caller's arrays. Throws Failure, and writes nothing, when a number is not finite.
void CopySolution(const ContactSolution& solution, nscdd_solution* target);

}  // namespace nscdd
