// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/platform_adapter.h"
#include "nscdd/step_problem.h"

namespace nscdd {

/// Interpenetration max(0, -gap) [m] over the candidates (pairs with a gap up to the alert distance) at some poses.
struct Interpenetration {
  double mean = 0.0;
  double p99 = 0.0;  ///< 99th percentile
  double max = 0.0;
};

/// `poses` are those of `ids` (ascending), which the adapter's host has.
Interpenetration MeasureInterpenetration(PlatformAdapter* adapter, const std::vector<std::int64_t>& ids,
                                         const std::vector<Pose>& poses, double alert);

/// What a step adds to the interpenetration p = max(0, -gap) between its detection at q_m and the next one at
/// q_e = q_end + (1 - theta) dt V, by contact, in two parts whose sum is p(q_e) - p(q_m) of the contacts that deepen:
///     solver    max(0, p_lin - p(q_m)),  p_lin = max(0, -(gap(q_m) + dt v_n)): what a violated law of velocities adds, 0 if
///     exact geometry  p(q_e) - p_lin: what gaps do beyond their linearisation (and what an engine moves without a velocity);
///     signed
/// Contacts that were no candidates at q_m count as geometry. Means over the candidates at q_m [m].
struct InterpenetrationGrowth {
  double solver_mean = 0.0;
  double solver_max = 0.0;
  double geometry_mean = 0.0;
  double geometry_max = 0.0;  ///< largest growth, not below 0
};

/// `end`: poses at the end of the step, by row of bodies.
InterpenetrationGrowth MeasureGrowth(PlatformAdapter* adapter, const StepProblem& step, const std::vector<Twist>& velocity,
                                     const std::vector<Pose>& end);

/// The `share` (0.99: 99th percentile) smallest value is not above the result; nearest rank; 0 of nothing.
double Percentile(std::vector<double> values, double share);

}  // namespace nscdd
