// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "newton/block_factor.h"
#include "problem/contact_frame.h"
#include "problem/subdomain_problem.h"

namespace nscdd {

/// Lower triangular 2 x 2 matrix of one contact.
struct ContactStiffness {
  double nn = 0.0, tn = 0.0, tt = 0.0;
};

inline Local Multiply(const ContactStiffness& e, Local x) { return {e.nn * x.n, e.tn * x.n + e.tt * x.t}; }

/// The linear systems (M + H E H^T) dV = b of one subdomain: E one ContactStiffness a contact, so they are not symmetric.
/// Prescribed bodies have dV = 0.
template <class Row>
class BodySystem {
 public:
  static constexpr int kDofs = Dofs(Row::kModel), kInertias = Inertias(Row::kModel);

  BodySystem(const SubdomainProblem& problem, const std::vector<Row>& rows, LinearLibrary library)
      : problem_(problem), rows_(rows), factor_(MakeBlockFactor<kDofs>(library)) {
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    for (const Row& c : rows) {
      if (IsFree(c.a) && IsFree(c.b)) edges.emplace_back(c.a, c.b);
    }
    matrix_.SetPattern(static_cast<int>(problem.body_count()), edges);
    for (const Row& c : rows) {
      const bool both = IsFree(c.a) && IsFree(c.b);
      places_.push_back({matrix_.Place(c.a, c.a), matrix_.Place(c.b, c.b), both ? matrix_.Place(c.a, c.b) : -1,
                         both ? matrix_.Place(c.b, c.a) : -1});
    }
    for (std::size_t b = 0; b < problem.body_count(); ++b) {
      for (int i = 0; i < kInertias; ++i) is_free_.push_back(IsFree(static_cast<std::int32_t>(b)) ? 1.0 : 0.0);
    }
    factor_->Analyse(matrix_);
  }

  std::size_t size() const { return kDofs * problem_.body_count(); }

  /// H^T V of one contact.
  Local Relative(std::size_t c, const std::vector<double>& velocity) const {
    const Row& row = rows_[c];
    return RelativeVelocity(row, &velocity[kDofs * row.a], &velocity[kDofs * row.b]);
  }
  /// out += H_c r on free bodies.
  void AddForce(std::size_t c, Local r, std::vector<double>* out) const {
    const Row& row = rows_[c];
    AddImpulse(row, r, &is_free_[kInertias * row.a], &is_free_[kInertias * row.b], &(*out)[kDofs * row.a],
               &(*out)[kDofs * row.b]);
  }
  /// 1/M of component d of body b; 0: prescribed.
  double InverseMass(std::size_t b, int d) const { return problem_.inverse_mass[kInertias * b + (d == 2)]; }

  /// Factorises M + H E H^T; false if it is singular.
  bool Factorise(const std::vector<ContactStiffness>& e) {
    std::fill(matrix_.values.begin(), matrix_.values.end(), 0.0);
    for (std::int32_t b = 0; b < matrix_.rows(); ++b) {
      double* block = matrix_.Block(matrix_.Place(b, b));
      for (int d = 0; d < kDofs; ++d) block[kDofs * d + d] = IsFree(b) ? 1.0 / InverseMass(b, d) : 1.0;
    }
    for (std::size_t c = 0; c < rows_.size(); ++c) AddContact(rows_[c], places_[c], e[c]);
    return factor_->Factorise(matrix_);
  }
  void Solve(std::vector<double>* x) { factor_->Solve(x->data()); }

 private:
  struct Places {
    std::int32_t aa, bb, ab, ba;
  };
  bool IsFree(std::int32_t b) const { return problem_.inverse_mass[kInertias * b] > 0.0; }

  void AddContact(const Row& c, const Places& places, const ContactStiffness& e) {
    if (e.nn == 0.0 && e.tt == 0.0) return;
    // Columns of H on A and on B.
    constexpr std::array<double, 2> kUnit{1.0, 1.0};
    std::array<double, 3> na{}, nb{}, ta{}, tb{};
    AddImpulse(c, {1.0, 0.0}, kUnit.data(), kUnit.data(), na.data(), nb.data());
    if constexpr (HasFriction(Row::kModel)) AddImpulse(c, {0.0, 1.0}, kUnit.data(), kUnit.data(), ta.data(), tb.data());
    const auto add = [&](std::int32_t place, const auto& nx, const auto& tx, const auto& ny, const auto& ty) {
      double* block = matrix_.Block(place);
      for (int i = 0; i < kDofs; ++i) {
        for (int j = 0; j < kDofs; ++j) block[kDofs * i + j] += (nx[i] * e.nn + tx[i] * e.tn) * ny[j] + tx[i] * e.tt * ty[j];
      }
    };
    if (IsFree(c.a)) add(places.aa, na, ta, na, ta);
    if (IsFree(c.b)) add(places.bb, nb, tb, nb, tb);
    if (places.ab < 0) return;
    add(places.ab, na, ta, nb, tb);
    add(places.ba, nb, tb, na, ta);
  }

  const SubdomainProblem& problem_;
  const std::vector<Row>& rows_;
  std::unique_ptr<BlockFactor<kDofs>> factor_;
  BlockMatrix<kDofs> matrix_;
  std::vector<Places> places_;
  std::vector<double> is_free_;  // Inertias per body: 1 or 0
};

/// Coulomb coefficient and the diagonal of W of one contact.
template <class Row>
struct ContactLaw {
  explicit ContactLaw(const Row& c) : offset(c.offset) {
    if constexpr (Row::kModel == ContactModel::kFrictionArms) {
      wn = c.wnn;
      wt = c.wtt;
    } else {
      wn = 1.0 / c.inverse_wnn;
      if constexpr (HasFriction(Row::kModel)) wt = 1.0 / c.inverse_wtt;
    }
    if constexpr (HasFriction(Row::kModel)) mu = c.friction;
  }
  double offset;
  double mu = 0.0, wn = 0.0, wt = 0.0;
};

template <class Row>
std::vector<ContactLaw<Row>> LawsOf(const std::vector<Row>& rows) {
  return {rows.begin(), rows.end()};
}

/// Impulse of contact c in the state's vector.
template <class Row>
Local ImpulseAt(const std::vector<double>& impulse, std::size_t c) {
  constexpr int kUnknowns = Unknowns(Row::kModel);
  return {impulse[kUnknowns * c], kUnknowns == 2 ? impulse[kUnknowns * c + kUnknowns - 1] : 0.0};
}
template <class Row>
void SetImpulse(std::size_t c, Local r, std::vector<double>* impulse) {
  constexpr int kUnknowns = Unknowns(Row::kModel);
  (*impulse)[kUnknowns * c] = r.n;
  if constexpr (kUnknowns == 2) (*impulse)[kUnknowns * c + 1] = r.t;
}

}  // namespace nscdd
