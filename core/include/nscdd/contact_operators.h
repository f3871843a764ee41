// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/contact_problem.h"

namespace nscdd {

/// A matrix in compressed columns; rows ascend within a column.
struct SparseMatrix {
  std::int32_t rows = 0;
  std::vector<std::int32_t> start;  ///< of each column in the two below, and their size
  std::vector<std::int32_t> row;
  std::vector<double> value;

  std::int32_t columns() const { return static_cast<std::int32_t>(start.size()) - 1; }
};

/// A contact problem as matrices. Rows of a free body: vx, vy, spin, bodies in the order of the problem; prescribed bodies have
/// none. Of a contact: n, t, contacts in the order of the problem. The problem reads
///     M v = H r + f,  u = H^T v + w,  and by elimination  u = W r + q,
///     0 <= u_n _|_ r_n >= 0,  |r_t| <= mu r_n,  u_t != 0 => r_t = -mu r_n sign(u_t),
/// where u_n = v_n + b_n and u_t = v_t: w holds b_n and what prescribed bodies do.
struct ContactOperators {
  SparseMatrix mass;                  ///< M = diag(m, m, I)
  SparseMatrix transfer;              ///< H
  SparseMatrix delassus;              ///< W = H^T M^-1 H
  std::vector<double> momentum;       ///< f = M V_f [N s, N m s]
  std::vector<double> offset;         ///< w [m/s]
  std::vector<double> free_velocity;  ///< q = H^T M^-1 f + w [m/s]
};

/// Throws Error when the matrices would be too large for 32-bit indices.
ContactOperators MakeContactOperators(const ContactProblem& problem);

/// Entries of the free bodies in the order of the rows of M.
std::vector<double> FreeRows(const ContactProblem& problem, const std::vector<Twist>& velocity);

/// u of every contact from its velocity v and the problem's b_n.
std::vector<double> LocalVelocities(const ContactProblem& problem, const std::vector<Twist>& velocity);

}  // namespace nscdd
