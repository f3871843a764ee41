// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/contact_problem.h"

namespace nscdd {

/// Part of the impulses (r_n, r_t of each contact) that no velocity sees: |P r|_D / |r|_D [-] with D = diag W and P the
/// D-orthogonal projection on the self-stresses {s: H s = 0} of the contacts that carry an impulse (s_t = 0 without friction).
/// The law of contact alone bounds it: another solver may return another part, with the same velocities. 0 without impulses.
double UndeterminedShare(const ContactProblem& problem, const std::vector<Vec2>& impulse);

}  // namespace nscdd
