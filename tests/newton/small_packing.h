// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/contact_problem.h"

namespace nscdd::test {

/// The contact problem of one step of a small packing, all of it drawn from `seed`: 2 to 40 disks (every third packing: with
/// clusters among them), radii 0.5 to 1.5, densities 1 to 10, friction 0 to 1, in a tilted open box or hopper; they fall and
/// are pressed for 5 to 150 steps before.
ContactProblem SmallPacking(unsigned seed);

}  // namespace nscdd::test
