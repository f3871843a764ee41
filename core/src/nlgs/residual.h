// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nlgs/sweep.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Parts of one subdomain of the natural residuals (nscdd/natural_residual.h), taken on the GLOBAL problem (undivided masses)
/// once the copies agree.
/// Neither bounds the error of what many contacts do together: nat is met by ever larger r where no solution exists, and both
/// overlook a load that has not gone through a long chain. Beside them, with u = v_n + b_n and E = |V - V_f|_M^2, are
///     P = sum_c p_c / E,   p_c = r_n max(0, u) + max(r_n, -u / W_nn) max(0, -u) + r_t v_t + mu r_n |v_t|   (no term is
///     negative) S = sum_c s_c / E,   s_c = r_n u + r_t v_t + (|r_t| >= 0.99 mu r_n: mu r_n |v_t|)
/// P is the error in the constitutive relation (de Saxce's bipotential). Exact impulses r* and velocities V* obey, without
/// friction, |V - V*|_M^2 <= sum r_n max(0, u) + (r_n* - r_n) max(0, -u). In a pile at rest, whose V* = 0, S is the part of the
/// load that the prescribed bodies lack. load_error is the largest of |S| and of a third of what the second half of the
/// iterations changed of the impulse on all prescribed bodies, over sqrt(E mass) (Monitor): where bodies move, S may cancel.
struct NaturalParts {
  double sum_e2 = 0.0;
  double sum_r2 = 0.0;
  double sum_power = 0.0;           ///< p_c [J]
  double sum_load = 0.0;            ///< s_c [J]
  double sum_change = 0.0;          ///< E [J]
  double sum_mass = 0.0;            ///< of the free bodies in contact [kg]
  double sum_x = 0.0, sum_y = 0.0;  ///< M (V - V_f) [N s]: what prescribed bodies give
  double worst = 0.0;               ///< [m/s], not yet divided by the scale
  std::int64_t worst_contact = -1;  ///< row of the rank's table of contacts
};

enum class Masses { kWhole, kDivided };

/// `masses`: kDivided measures the subdomain as a problem of its own (interface impulses frozen).
NaturalParts NaturalResidual(const SubdomainProblem& problem, const SubdomainState& state, Masses masses = Masses::kWhole);

/// nat from the sums over all subdomains.
double Nat(double sum_e2, double sum_r2, const ResidualScales& scales);
double NatMax(double worst, const ResidualScales& scales);
/// E [J], at least 1e-6 of what loads and approach exchange.
double ChangeEnergy(const NaturalParts& parts, const ResidualScales& scales);
/// sqrt(E mass) [N s]: at least the impulse on all prescribed bodies, and the weight dt g of a pile at rest.
double ImpulseScale(const NaturalParts& parts, const ResidualScales& scales);
/// nat, nat_max, power = P, load_error = |S| and wall_error from the parts of all subdomains. Measured from above
/// in cold and warm solves of columns, boxes and lattices, wall_error = 3 (|S| + P) sqrt(mass max(E, exchange)).
void SetNatural(const NaturalParts& parts, const ResidualScales& scales, Residuals* residuals);
/// p_c of each contact [J].
std::vector<double> ViolatedPowers(const SubdomainProblem& problem, const SubdomainState& state);

/// LMGC90's criteria from the sums and maxima over all subdomains (s.active etc. summed, maxima maximised):
///     QuadWR = sqrt(sum |Wr|^2 / na),  MeanWRR = sum r.Wr / na
///     quad = max(sqrt(sum dv^2 / na) / QuadWR, sqrt(sum dv^2 rbar^2 / na) / MeanWRR)
///     maxm = max(max dv / QuadWR, max dv rbar / MeanWRR),   qm16 = max(quad, maxm / 16.666)
/// All are 0 when no contact carries an impulse, or when sum r.Wr <= 1e-18 of the loads' energy (scale-free floor).
struct StagnationMeasures {
  double quad = 0.0;
  double maxm = 0.0;
  double qm16 = 0.0;
  double quad_wr = 0.0;  ///< QuadWR [m/s], scale of the relative interface jump
};
StagnationMeasures Stagnation(const SweepStatistics& s, const ResidualScales& scales);

/// The number that `criterion` compares with the tolerance.
double Measure(Criterion criterion, const Residuals& residuals);

/// Bounds that "converged" asks for beside the criterion. LMGC90's criteria keep to its definitions: power alone is bounded, by
/// what only impulses without a solution exceed.
struct Bounds {
  double power, load_error;
};
/// load_error <= 8 tolerances, but at least 0.008 and at most 0.08; P <= 25 times as much, but at most 1.
Bounds BoundsOf(const StoppingOptions& options);
/// The largest of the criterion and, in units of the tolerance, of what is bounded beside it: converged where it is at most the
/// tolerance. With tolerance 0 the criterion alone.
double Measure(const StoppingOptions& options, const Residuals& residuals);

}  // namespace nscdd
