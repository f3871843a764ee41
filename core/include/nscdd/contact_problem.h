// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/communicator.h"
#include "nscdd/contact_table.h"
#include "nscdd/options.h"
#include "nscdd/report.h"
#include "nscdd/vector.h"

namespace nscdd {

/// One contact problem: find r, V with  V = V_f + M^-1 H r,  v = H^T V,  0 <= v_n + b_n _|_ r_n >= 0,  Coulomb.
/// Contacts are swept in the order given, subdomain by subdomain. Columns of bodies and contacts as in the two tables.
struct ContactProblem {
  std::vector<double> mass;          ///< [kg]; +inf: prescribed motion
  std::vector<double> inertia;       ///< [kg m^2]; +inf: prescribed motion
  std::vector<Twist> free_velocity;  ///< V_f; of prescribed bodies: their velocity
  std::vector<Wrench> impulse;       ///< dt f [N s]: scales of the residuals only
  ContactTable contacts;             ///< a, b are rows of the columns above; keys need not be sorted
  std::vector<double> offset;        ///< b_n [m/s]
  std::vector<int> subdomain;        ///< of each contact, from 0; empty: all in 0
  double approach_speed = 0.0;       ///< [m/s] largest -v_n before the step: scale of nat_max
};

/// Subdomains for contacts at these sites: the box of the sites is cut into nx x ny equal cells, a site on a cut goes to the
/// upper one. Cell (ix, iy) is subdomain ix + nx iy.
std::vector<int> SubdomainsOf(std::span<const Vec2> sites, int nx, int ny);

/// What a solver makes of a ContactProblem: rows are those of its bodies and contacts.
struct ContactSolution {
  std::vector<Twist> velocity;          ///< V of each body; of one without contact: V_f
  std::vector<Vec2> impulse;            ///< (r_n, r_t) of each contact [N s]
  std::vector<Vec2> relative_velocity;  ///< (v_n, v_t) of each contact [m/s]
  SolveReport report;
};

/// Solves one problem on this process. `warm` (empty, or one entry per contact) are the first impulses; interface impulses
/// begin at those that they imply. The partition in `options` is not read: problem.subdomain says it. Throws Error on
/// inconsistent sizes or numbers.
ContactSolution SolveContactProblem(const ContactProblem& problem, const AlgorithmOptions& options,
                                    const std::vector<Vec2>& warm = {});

}  // namespace nscdd
