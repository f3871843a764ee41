// SPDX-License-Identifier: Apache-2.0
#include "problem/contact_operators.h"

#include <array>
#include <cmath>
#include <limits>

#include "nscdd/contact_kinematics.h"
#include "nscdd/error.h"

namespace nscdd {
namespace {

/// A column of H on one body: what a unit impulse gives to its x, y and moment, and what its velocity gives to v.
using Column = std::array<double, 3>;
struct Side {
  std::int32_t body;
  Column n, t;
};

/// H of one contact, on A and on B.
std::array<Side, 2> SidesOf(const ContactTable& c, std::size_t i) {
  const ContactKinematics h = KinematicsOf(c, i);
  return {Side{c.a[i], {-h.n.x, -h.n.y, -h.turn_na}, {-h.t.x, -h.t.y, -h.turn_ta}},
          Side{c.b[i], {h.n.x, h.n.y, h.turn_nb}, {h.t.x, h.t.y, h.turn_tb}}};
}

double Product(const Column& h, const Twist& v) { return h[0] * v.vx + h[1] * v.vy + h[2] * v.spin; }

/// First row of each free body in M; -1 of prescribed ones.
std::vector<std::int32_t> FirstRows(const ContactProblem& p, std::int32_t* count) {
  std::vector<std::int32_t> first;
  *count = 0;
  for (const double mass : p.mass) {
    first.push_back(std::isinf(mass) ? -1 : *count);
    if (!std::isinf(mass)) *count += 3;
  }
  return first;
}

SparseMatrix MassMatrix(const ContactProblem& p, std::int32_t rows) {
  SparseMatrix m(rows);
  std::int32_t row = 0;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (std::isinf(p.mass[i])) continue;
    for (const double x : {p.mass[i], p.mass[i], p.inertia[i]}) m.AppendColumn({{row++, x}});
  }
  return m;
}

SparseMatrix TransferMatrix(const ContactProblem& p, const std::vector<std::int32_t>& first, std::int32_t rows) {
  SparseMatrix h(rows);
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    std::map<std::int32_t, double> n, t;
    for (const Side& side : SidesOf(p.contacts, c)) {
      if (first[side.body] < 0) continue;
      for (int k = 0; k < 3; ++k) {
        if (side.n[k] != 0.0) n[first[side.body] + k] = side.n[k];
        if (side.t[k] != 0.0) t[first[side.body] + k] = side.t[k];
      }
    }
    h.AppendColumn(n);
    h.AppendColumn(t);
  }
  return h;
}

/// Each column of W: contacts that share a free body with it.
SparseMatrix DelassusMatrix(const ContactProblem& p) {
  std::vector<std::vector<std::size_t>> contacts_of(p.mass.size());
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    contacts_of[p.contacts.a[c]].push_back(c);
    contacts_of[p.contacts.b[c]].push_back(c);
  }
  SparseMatrix w(static_cast<std::int32_t>(2 * p.contacts.size()));
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    std::map<std::int32_t, double> n, t;
    for (const Side& mine : SidesOf(p.contacts, c)) {
      const double m = p.mass[mine.body], inertia = p.inertia[mine.body];
      if (std::isinf(m)) continue;
      const Twist vn{mine.n[0] / m, mine.n[1] / m, mine.n[2] / inertia}, vt{mine.t[0] / m, mine.t[1] / m, mine.t[2] / inertia};
      for (const std::size_t d : contacts_of[mine.body]) {
        const auto row = static_cast<std::int32_t>(2 * d);
        for (const Side& other : SidesOf(p.contacts, d)) {
          if (other.body != mine.body) continue;
          n[row] += Product(other.n, vn);
          n[row + 1] += Product(other.t, vn);
          t[row] += Product(other.n, vt);
          t[row + 1] += Product(other.t, vt);
        }
      }
    }
    w.AppendColumn(n);
    w.AppendColumn(t);
    if (w.row.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / 2) {
      throw Error("the contact problem is too large for the 32-bit indices of FCLib; export a smaller sample");
    }
  }
  return w;
}

}  // namespace

std::vector<double> LocalVelocities(const ContactProblem& p, const std::vector<Twist>& velocity) {
  std::vector<double> u;
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    double n = p.offset[c], t = 0.0;
    for (const Side& side : SidesOf(p.contacts, c)) {
      n += Product(side.n, velocity[side.body]);
      t += Product(side.t, velocity[side.body]);
    }
    u.push_back(n);
    u.push_back(t);
  }
  return u;
}

std::vector<double> FreeRows(const ContactProblem& p, const std::vector<Twist>& velocity) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (std::isinf(p.mass[i])) continue;
    rows.insert(rows.end(), {velocity[i].vx, velocity[i].vy, velocity[i].spin});
  }
  return rows;
}

ContactOperators MakeContactOperators(const ContactProblem& p) {
  std::int32_t rows = 0;
  const std::vector<std::int32_t> first = FirstRows(p, &rows);
  ContactOperators result{MassMatrix(p, rows), TransferMatrix(p, first, rows), DelassusMatrix(p), {}, {}, {}};
  std::vector<Twist> prescribed = p.free_velocity;
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (std::isinf(p.mass[i])) continue;
    prescribed[i] = {};
    const Twist& v = p.free_velocity[i];
    result.momentum.insert(result.momentum.end(), {p.mass[i] * v.vx, p.mass[i] * v.vy, p.inertia[i] * v.spin});
  }
  result.offset = LocalVelocities(p, prescribed);
  result.free_velocity = LocalVelocities(p, p.free_velocity);
  return result;
}

}  // namespace nscdd
