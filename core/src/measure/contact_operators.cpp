// SPDX-License-Identifier: Apache-2.0
#include "nscdd/contact_operators.h"

#include <Eigen/SparseCore>
#include <cmath>
#include <limits>

#include "nscdd/contact_kinematics.h"
#include "nscdd/error.h"

namespace nscdd {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

bool IsFree(const ContactProblem& p, std::size_t body) { return !std::isinf(p.mass[body]); }

SparseMatrix ColumnsOf(const Matrix& m) {
  return {static_cast<std::int32_t>(m.rows()),
          {m.outerIndexPtr(), m.outerIndexPtr() + m.cols() + 1},
          {m.innerIndexPtr(), m.innerIndexPtr() + m.nonZeros()},
          {m.valuePtr(), m.valuePtr() + m.nonZeros()}};
}

/// M, or its inverse.
Matrix MassMatrix(const ContactProblem& p, bool inverse) {
  std::vector<double> diagonal;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (IsFree(p, i)) diagonal.insert(diagonal.end(), {p.mass[i], p.mass[i], p.inertia[i]});
  }
  Matrix m(std::ssize(diagonal), std::ssize(diagonal));
  for (Eigen::Index k = 0; k < m.rows(); ++k) m.insert(k, k) = inverse ? 1.0 / diagonal[k] : diagonal[k];
  m.makeCompressed();
  return m;
}

Matrix TransferMatrix(const ContactProblem& p, Eigen::Index rows) {
  std::vector<std::int32_t> first;  // row of each free body in M
  std::int32_t next = 0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    first.push_back(next);
    if (IsFree(p, i)) next += 3;
  }
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::int32_t body, std::size_t column, Vec2 direction, double turn) {
    if (!IsFree(p, body)) return;
    const double values[] = {direction.x, direction.y, turn};
    for (int k = 0; k < 3; ++k) {
      if (values[k] != 0.0) entries.emplace_back(first[body] + k, static_cast<int>(column), values[k]);
    }
  };
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    const ContactKinematics h = KinematicsOf(p.contacts, c);
    add(p.contacts.a[c], 2 * c, -1.0 * h.n, -h.turn_na);
    add(p.contacts.b[c], 2 * c, h.n, h.turn_nb);
    add(p.contacts.a[c], 2 * c + 1, -1.0 * h.t, -h.turn_ta);
    add(p.contacts.b[c], 2 * c + 1, h.t, h.turn_tb);
  }
  Matrix m(rows, 2 * std::ssize(p.contacts.gap));
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

/// W has four entries for each ordered pair of contacts that share a free body.
void CheckSize(const ContactProblem& p) {
  std::vector<double> contacts(p.mass.size());
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    contacts[p.contacts.a[c]] += 1.0;
    contacts[p.contacts.b[c]] += 1.0;
  }
  double entries = 0.0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (IsFree(p, i)) entries += 4.0 * contacts[i] * contacts[i];
  }
  if (entries > std::numeric_limits<std::int32_t>::max())
    throw Error("the contact problem is too large for the 32-bit indices of FCLib; export a smaller sample");
}

}  // namespace

std::vector<double> LocalVelocities(const ContactProblem& p, const std::vector<Twist>& velocity) {
  std::vector<double> u;
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    const Vec2 v = RelativeVelocity(KinematicsOf(p.contacts, c), velocity[p.contacts.a[c]], velocity[p.contacts.b[c]]);
    u.insert(u.end(), {v.x + p.offset[c], v.y});
  }
  return u;
}

std::vector<double> FreeRows(const ContactProblem& p, const std::vector<Twist>& velocity) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (IsFree(p, i)) rows.insert(rows.end(), {velocity[i].vx, velocity[i].vy, velocity[i].spin});
  }
  return rows;
}

ContactOperators MakeContactOperators(const ContactProblem& p) {
  CheckSize(p);
  const Matrix mass = MassMatrix(p, false), h = TransferMatrix(p, mass.rows());
  const Matrix w = h.transpose() * MassMatrix(p, true) * h;
  ContactOperators result{ColumnsOf(mass), ColumnsOf(h), ColumnsOf(w), FreeRows(p, p.free_velocity), {}, {}};
  for (std::size_t k = 0; k < result.momentum.size(); ++k) result.momentum[k] *= result.mass.value[k];
  std::vector<Twist> prescribed = p.free_velocity;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (IsFree(p, i)) prescribed[i] = {};
  }
  result.offset = LocalVelocities(p, prescribed);
  result.free_velocity = LocalVelocities(p, p.free_velocity);
  return result;
}

}  // namespace nscdd
