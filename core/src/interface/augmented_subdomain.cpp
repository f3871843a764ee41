// SPDX-License-Identifier: Apache-2.0
#include "interface/augmented_subdomain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "problem/contact_frame.h"

namespace nscdd {

int AugmentedSubdomain::DofsFor(ContactModel model, Compatibility compatibility) {
  if (HasArms(model)) return 3;
  return HasFriction(model) && compatibility != Compatibility::kNormal ? 3 : 2;
}

AugmentedSubdomain::AugmentedSubdomain(const SubdomainProblem& problem, const AugmentedInterfaceOptions& options,
                                       double reference_mass, std::vector<double> restoring)
    : problem_(problem),
      compatibility_(options.compatibility),
      status_compatibility_(options.status_compatibility),
      local_velocity_(options.local_velocity),
      dofs_(DofsFor(problem.model, options.compatibility)),
      node_of_copy_(problem.body_count(), -1),
      restoring_(std::move(restoring)) {
  const int inertias = Inertias(problem.model);
  for (std::size_t copy = 0; copy < problem.body_count(); ++copy) {
    if (problem.inverse_mass[inertias * copy] == 0.0) continue;
    node_of_copy_[copy] = nodes();
    copy_of_node_.push_back(static_cast<std::int32_t>(copy));
  }
  VisitRows(problem, [&](const auto& rows) { MakeColumns(rows, options.lambda_scale, options.lambda, reference_mass); });
}

template <class Row>
void AugmentedSubdomain::MakeColumns(const std::vector<Row>& rows, LambdaScale scale, double lambda, double reference_mass) {
  constexpr int kInertias = Inertias(Row::kModel);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& c = rows[k];
    // Lambda does not depend on the cuts: with kContact it is measured by the undivided W_nn.
    const auto share = [&](std::int32_t copy) {
      return problem_.multiplicity.empty() ? 1.0 : 1.0 / problem_.multiplicity[copy];
    };
    const Delassus w = DelassusBlock(c, &problem_.inverse_mass[kInertias * c.a], &problem_.inverse_mass[kInertias * c.b],
                                     share(c.a), share(c.b));
    Column normal{c.a, c.b, 0.0, {-c.n.x, -c.n.y, 0.0}, {c.n.x, c.n.y, 0.0}, -c.offset, true, static_cast<std::int32_t>(k),
                  true};
    if constexpr (HasArms(Row::kModel)) {
      normal.ga[2] = -c.turn_na;
      normal.gb[2] = c.turn_nb;
    }
    const double weight = scale == LambdaScale::kMass ? lambda * reference_mass : lambda / w.nn;
    columns_.push_back(normal);
    full_weight_.push_back(weight);
    if constexpr (HasFriction(Row::kModel)) {
      if (compatibility_ == Compatibility::kNormal) continue;
      Column tangent{c.a, c.b, 0.0, {-c.n.y, c.n.x, -c.turn_ta}, {c.n.y, -c.n.x, c.turn_tb}, 0.0, false, normal.contact, false};
      columns_.push_back(tangent);
      full_weight_.push_back(weight);
    }
  }
}

void AugmentedSubdomain::ChooseColumns(const SubdomainState& state) {
  VisitRows(problem_, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      Column& c = columns_[k];
      const ContactStatus status = StatusOf(rows[c.contact], &state.impulse[Unknowns(Row::kModel) * c.contact]);
      bool on = status != ContactStatus::kOpen;
      if (!c.is_normal) {
        c.is_known = status == ContactStatus::kSticking;  // no velocity left
        if (compatibility_ == Compatibility::kSticking) on = on && c.is_known;
      }
      c.weight = on ? full_weight_[k] : 0.0;
    }
  });
}

void AugmentedSubdomain::AppendPattern(std::span<const std::int32_t> number, std::vector<std::int32_t>* row,
                                       std::vector<std::int32_t>* column) const {
  const auto block = [&](int i, int j) {  // lower triangle of the block of two nodes
    const std::int32_t first = std::max(number[i], number[j]), second = std::min(number[i], number[j]);
    for (int p = 0; p < dofs_; ++p) {
      for (int q = 0; q < (i == j ? p + 1 : dofs_); ++q) {
        row->push_back(dofs_ * first + p);
        column->push_back(dofs_ * second + q);
      }
    }
  };
  for (int i = 0; i < nodes(); ++i) {
    for (int p = 0; p < dofs_; ++p) {
      row->push_back(dofs_ * number[i] + p);
      column->push_back(dofs_ * number[i] + p);
    }
  }
  for (const Column& c : columns_) {
    if (!c.is_normal) continue;
    const int i = NodeOf(c.a), j = NodeOf(c.b);
    if (i >= 0) block(i, i);
    if (j >= 0) block(j, j);
    if (i >= 0 && j >= 0) block(i, j);
  }
}

void AugmentedSubdomain::AppendValues(std::span<const std::int32_t> number, std::vector<double>* values) const {
  for (int i = 0; i < nodes(); ++i) {
    for (int p = 0; p < dofs_; ++p) values->push_back(MassOf(i, p));
  }
  // The order is that of AppendPattern(): masses, then for each contact the blocks of A, of B, and between them.
  const std::size_t per_contact = compatibility_ == Compatibility::kNormal || !HasFriction(problem_.model) ? 1 : 2;
  for (std::size_t k = 0; k < columns_.size(); k += per_contact) {
    const Column* c = &columns_[k];
    const int i = NodeOf(c->a), j = NodeOf(c->b);
    const auto block = [&](auto left, auto right, bool triangle) {
      for (int p = 0; p < dofs_; ++p) {
        for (int q = 0; q < (triangle ? p + 1 : dofs_); ++q) {
          double sum = 0.0;
          for (std::size_t s = 0; s < per_contact; ++s) sum += c[s].weight * left(c[s])[p] * right(c[s])[q];
          values->push_back(sum);
        }
      }
    };
    const auto a = [](const Column& column) { return column.ga; };
    const auto b = [](const Column& column) { return column.gb; };
    if (i >= 0) block(a, a, true);
    if (j >= 0) block(b, b, true);
    if (i >= 0 && j >= 0) {
      if (number[i] > number[j]) {
        block(a, b, false);
      } else {
        block(b, a, false);
      }
    }
  }
}

double AugmentedSubdomain::MassOf(int node, int dof) const {
  return 1.0 / problem_.inverse_mass[Inertias(problem_.model) * copy_of_node_[node] + (dof == 2)];
}

double AugmentedSubdomain::PrescribedPart(const Column& c, const SubdomainState& state) const {
  const int stride = Dofs(problem_.model);
  double v = 0.0;
  for (int d = 0; d < dofs_; ++d) {
    if (NodeOf(c.a) < 0) v += c.ga[d] * state.velocity[stride * c.a + d];
    if (NodeOf(c.b) < 0) v += c.gb[d] * state.velocity[stride * c.b + d];
  }
  return v;
}

/// v_E of a column, by the option local_velocity, with the restoring speed.
double AugmentedSubdomain::OldVelocity(const Column& c, const SubdomainState& state, std::span<const double> left) const {
  const double restoring = c.is_normal && !restoring_.empty() ? restoring_[c.contact] : 0.0;
  const bool at_rest = !c.is_normal && (status_compatibility_ == StatusCompatibility::kNormal ||
                                        (status_compatibility_ == StatusCompatibility::kSticking && !c.is_known));
  if (at_rest) return 0.0;
  if (local_velocity_ == LocalVelocity::kLocal) return restoring + (c.is_known ? c.velocity_known : left[c.contact]);
  const int stride = Dofs(problem_.model);
  double v = restoring;
  for (int d = 0; d < dofs_; ++d) {
    v += c.ga[d] * state.velocity[stride * c.a + d] + c.gb[d] * state.velocity[stride * c.b + d];
  }
  return v;
}

double AugmentedSubdomain::Dot(const Column& c, std::span<const double> nodes) const {
  const int i = NodeOf(c.a), j = NodeOf(c.b);
  double v = 0.0;
  for (int d = 0; d < dofs_; ++d) {
    if (i >= 0) v += c.ga[d] * nodes[dofs_ * i + d];
    if (j >= 0) v += c.gb[d] * nodes[dofs_ * j + d];
  }
  return v;
}

void AugmentedSubdomain::Add(const Column& c, double factor, std::vector<double>* nodes) const {
  const int i = NodeOf(c.a), j = NodeOf(c.b);
  for (int d = 0; d < dofs_; ++d) {
    if (i >= 0) (*nodes)[dofs_ * i + d] += factor * c.ga[d];
    if (j >= 0) (*nodes)[dofs_ * j + d] += factor * c.gb[d];
  }
}

std::vector<double> AugmentedSubdomain::RightHandSide(const SubdomainState& state, std::span<const double> left) const {
  const int stride = Dofs(problem_.model);
  std::vector<double> y(static_cast<std::size_t>(dofs_) * nodes());
  for (int i = 0; i < nodes(); ++i) {
    for (int d = 0; d < dofs_; ++d) y[dofs_ * i + d] = MassOf(i, d) * state.velocity[stride * copy_of_node_[i] + d];
  }
  for (const Column& c : columns_) {
    if (c.weight != 0.0) Add(c, c.weight * (OldVelocity(c, state, left) - PrescribedPart(c, state)), &y);
  }
  return y;
}

std::vector<double> AugmentedSubdomain::ImpulseChange(const SubdomainState& state, std::span<const double> left,
                                                      std::span<const double> solution) const {
  const int stride = Dofs(problem_.model);
  std::vector<double> df(static_cast<std::size_t>(dofs_) * nodes());
  for (int i = 0; i < nodes(); ++i) {
    for (int d = 0; d < dofs_; ++d) {
      df[dofs_ * i + d] = MassOf(i, d) * (state.velocity[stride * copy_of_node_[i] + d] - solution[dofs_ * i + d]);
    }
  }
  for (const Column& c : columns_) {
    if (c.weight == 0.0) continue;
    Add(c, c.weight * (OldVelocity(c, state, left) - PrescribedPart(c, state) - Dot(c, solution)), &df);
  }
  return df;
}

std::vector<double> AugmentedSubdomain::Multiply(std::span<const double> x) const {
  std::vector<double> y(x.size());
  for (int i = 0; i < nodes(); ++i) {
    for (int d = 0; d < dofs_; ++d) y[dofs_ * i + d] = MassOf(i, d) * x[dofs_ * i + d];
  }
  for (const Column& c : columns_) {
    if (c.weight != 0.0) Add(c, c.weight * Dot(c, x), &y);
  }
  return y;
}

std::vector<double> AugmentedSubdomain::Diagonal() const {
  std::vector<double> y(static_cast<std::size_t>(dofs_) * nodes());
  for (int i = 0; i < nodes(); ++i) {
    for (int d = 0; d < dofs_; ++d) y[dofs_ * i + d] = MassOf(i, d);
  }
  for (const Column& c : columns_) {
    const int i = NodeOf(c.a), j = NodeOf(c.b);
    for (int d = 0; d < dofs_; ++d) {
      if (i >= 0) y[dofs_ * i + d] += c.weight * c.ga[d] * c.ga[d];
      if (j >= 0) y[dofs_ * j + d] += c.weight * c.gb[d] * c.gb[d];
    }
  }
  return y;
}

}  // namespace nscdd
