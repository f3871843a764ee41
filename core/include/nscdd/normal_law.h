// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "nscdd/options.h"

namespace nscdd {

/// Whether a step solves for displacements first and for velocities, where something rebounds, afterwards.
constexpr bool HasTwoStages(NormalLaw law) { return law == NormalLaw::kImpact; }

/// Whether the law sees a candidate with this gap [m] at all.
inline bool Sees(NormalLaw law, double gap) { return law != NormalLaw::kStrict || !(gap > 0.0); }

/// Offset b_n [m/s] of the normal law 0 <= v_n + b_n _|_ r_n >= 0 in the laws of one stage. `approach` is v_n before the step
/// [m/s]; Newton's restitution e asks for v_n >= -e approach where the contact is closed and approaching. A gap below 1e-9 of
/// the sum of the levers, or one that closes within a thousandth of the step, is closed: the law itself brings contacts to a
/// gap of zero give or take rounding and the solver's residual, which must not decide about a bounce.
inline double NormalOffset(const SteppingOptions& o, double gap, double levers, double approach, double restitution,
                           double dt) {
  const bool closed = gap <= std::max(1e-9 * levers, -1e-3 * dt * approach);
  const double rebound = closed && approach < 0.0 ? restitution * approach : 0.0;
  const double open = o.normal_law == NormalLaw::kStrict ? 0.0 : std::max(0.0, gap) / dt;
  if (o.normal_law != NormalLaw::kFeedback) return open + rebound;
  return open + rebound - std::min(o.feedback_cap, o.feedback_beta * std::max(0.0, -(gap + o.feedback_slop)) / dt);
}

}  // namespace nscdd
