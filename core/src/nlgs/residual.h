// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nlgs/sweep.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "problem/partitioned_problem.h"

namespace nscdd {

/// Parts of one subdomain of the natural residuals, taken on the GLOBAL problem (undivided masses) once the copies agree:
///     e_c = r_c - P_K(r_c - rho_c (v_n + b_n + mu |v_t|, v_t)),   rho_c = 1 / max(W_nn, W_tt)  (1 / W_nn without friction)
///     P_K: projection on the Coulomb cone |r_t| <= mu r_n;  without friction P(z) = max(0, z_n)
///     nat = ||e|| / max(||r||, 1e-3 ||dt f||);   0 without contacts
///     nat_max = max over contacts of max(e_n, e_t) / velocity scale, with  e_n = |min(v_n + b_n, W_nn r_n)|,
///               e_t = |W_tt r_t - clamp(W_tt r_t - v_t, +-W_tt mu max(r_n, 0))|;   0 when the scale vanishes
struct NaturalParts {
  double sum_e2 = 0.0;
  double sum_r2 = 0.0;
  double worst = 0.0;               ///< [m/s], not yet divided by the scale
  std::int64_t worst_contact = -1;  ///< row of the rank's table of contacts
};

enum class Masses { kWhole, kDivided };

/// `masses`: kDivided measures the subdomain as a problem of its own (interface impulses frozen).
NaturalParts NaturalResidual(const SubdomainProblem& problem, const SubdomainState& state, Masses masses = Masses::kWhole);

/// nat from the sums over all subdomains.
double Nat(double sum_e2, double sum_r2, const ResidualScales& scales);
double NatMax(double worst, const ResidualScales& scales);

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

}  // namespace nscdd
