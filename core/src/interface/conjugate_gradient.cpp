// SPDX-License-Identifier: Apache-2.0
#include "interface/conjugate_gradient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "nscdd/agreement.h"
#include "parallel/ordered_reduction.h"

namespace nscdd {

AugmentedInterface::ConjugateGradient::ConjugateGradient(const PartitionedProblem& problem,
                                                         const std::vector<AugmentedSubdomain>& parts,
                                                         const AugmentedInterfaceOptions& options, Communicator* communicator,
                                                         InterfaceWorkspace* workspace)
    : problem_(problem),
      parts_(parts),
      options_(options),
      communicator_(communicator),
      workspace_(workspace),
      dofs_(parts.front().dofs()),
      average_(problem.interface, dofs_, communicator) {
  // Solvers outlive a step, so that equal patterns are analysed once.
  while (workspace_->local.size() < parts.size()) {
    workspace_->local.push_back(std::make_unique<KeptSolver>(MakeLocalSolver(options.linear_solver), communicator));
  }
  if (options.preconditioner != Preconditioner::kDirichlet) return;
  while (workspace_->interior.size() < parts.size()) {
    workspace_->interior.push_back(std::make_unique<KeptSolver>(MakeLocalSolver(options.linear_solver), communicator));
  }
  // Number the nodes inside: those that are no copy of an interface body.
  for (std::size_t e = 0; e < parts.size(); ++e) interior_.emplace_back(parts[e].nodes(), 0);
  for (const auto& copy : problem.interface.copies) interior_[copy.problem][parts[copy.problem].NodeOf(copy.body)] = -1;
  for (auto& numbers : interior_) {
    std::int32_t next = 0;
    for (std::int32_t& number : numbers) {
      if (number == 0) number = next++;
    }
  }
}

/// A matrix that cannot be factorised is met by the rank that has it.
void AugmentedInterface::ConjugateGradient::SetMatrices() {
  RunTogether(communicator_, [&] { SetLocalMatrices(); });
}

void AugmentedInterface::ConjugateGradient::SetLocalMatrices() {
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    if (parts_[e].nodes() == 0) continue;
    std::vector<std::int32_t> identity(parts_[e].nodes()), row, column;
    std::iota(identity.begin(), identity.end(), 0);
    std::vector<double> values;
    parts_[e].AppendPattern(identity, &row, &column);
    parts_[e].AppendValues(identity, &values);
    if (!interior_.empty()) {  // rows and columns of the copies left out
      const auto& number = interior_[e];
      const auto count = static_cast<int>(std::count_if(number.begin(), number.end(), [](int n) { return n >= 0; }));
      std::vector<std::int32_t> inner_row, inner_column;
      std::vector<double> inner_values;
      for (std::size_t k = 0; k < row.size(); ++k) {
        const std::int32_t i = number[row[k] / dofs_], j = number[column[k] / dofs_];
        if (i < 0 || j < 0) continue;
        inner_row.push_back(dofs_ * i + row[k] % dofs_);
        inner_column.push_back(dofs_ * j + column[k] % dofs_);
        inner_values.push_back(values[k]);
      }
      if (count > 0) {
        workspace_->interior[e]->Set(dofs_ * count, std::move(inner_row), std::move(inner_column), std::move(inner_values));
      }
    }
    workspace_->local[e]->Set(dofs_ * parts_[e].nodes(), std::move(row), std::move(column), std::move(values));
  }
}

/// A vector on the copies as one on the nodes of a part, zero inside.
std::vector<double> AugmentedInterface::ConjugateGradient::Spread(std::size_t part, const std::vector<double>& x) const {
  std::vector<double> nodes(static_cast<std::size_t>(dofs_) * parts_[part].nodes());
  for (std::size_t k = 0; k < problem_.interface.copies.size(); ++k) {
    const auto& copy = problem_.interface.copies[k];
    if (static_cast<std::size_t>(copy.problem) != part) continue;
    const int node = parts_[part].NodeOf(copy.body);
    for (int d = 0; d < dofs_; ++d) nodes[dofs_ * node + d] = x[dofs_ * k + d];
  }
  return nodes;
}

void AugmentedInterface::ConjugateGradient::Collect(std::size_t part, const std::vector<double>& nodes,
                                                    std::vector<double>* x) const {
  for (std::size_t k = 0; k < problem_.interface.copies.size(); ++k) {
    const auto& copy = problem_.interface.copies[k];
    if (static_cast<std::size_t>(copy.problem) != part) continue;
    const int node = parts_[part].NodeOf(copy.body);
    for (int d = 0; d < dofs_; ++d) (*x)[dofs_ * k + d] = nodes[dofs_ * node + d];
  }
}

std::vector<double> AugmentedInterface::ConjugateGradient::ApplyInverse(const std::vector<double>& x) {
  std::vector<double> y(x.size());
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    std::vector<double> nodes = Spread(e, x);
    if (!nodes.empty()) workspace_->local[e]->Solve(nodes);
    Collect(e, nodes, &y);
  }
  average_.Project(&y);
  return y;
}

std::vector<double> AugmentedInterface::ConjugateGradient::Precondition(const std::vector<double>& residual) {
  if (options_.preconditioner == Preconditioner::kNone) return residual;
  std::vector<double> z(residual.size());
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    if (parts_[e].nodes() == 0) continue;
    std::vector<double> nodes = Spread(e, residual);
    if (options_.preconditioner == Preconditioner::kDiagonal) {
      const std::vector<double> diagonal = parts_[e].Diagonal();
      for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] *= diagonal[i];
    } else {
      std::vector<double> product = parts_[e].Multiply(nodes);
      if (options_.preconditioner == Preconditioner::kDirichlet) {
        // S x = M_GG x - M_GI M_II^-1 M_IG x: the inside gives way.
        const auto& number = interior_[e];
        std::vector<double> inner;
        for (std::size_t i = 0; i < number.size(); ++i) {
          if (number[i] >= 0) inner.insert(inner.end(), &product[dofs_ * i], &product[dofs_ * i] + dofs_);
        }
        if (!inner.empty()) workspace_->interior[e]->Solve(inner);
        for (std::size_t i = 0; i < number.size(); ++i) {
          for (int d = 0; d < dofs_ && number[i] >= 0; ++d) nodes[dofs_ * i + d] = -inner[dofs_ * number[i] + d];
        }
        product = parts_[e].Multiply(nodes);
      }
      nodes = std::move(product);
    }
    Collect(e, nodes, &z);
  }
  average_.Project(&z);
  return z;
}

AugmentedInterface::ConjugateGradient::Products AugmentedInterface::ConjugateGradient::Reduce(
    const std::vector<double>& r, const std::vector<double>& z, const std::vector<double>& w) const {
  std::vector<ReductionPart<Products>> parts(parts_.size());
  for (std::size_t k = 0; k < problem_.interface.copies.size(); ++k) {
    Products& part = parts[problem_.interface.copies[k].problem].sum;
    for (std::size_t i = dofs_ * k; i < dofs_ * (k + 1); ++i) {
      part.rz += r[i] * z[i];
      part.wz += w[i] * z[i];
      part.rr += r[i] * r[i];
    }
  }
  return ReduceInOrder(parts, communicator_).sum;
}

std::vector<double> AugmentedInterface::ConjugateGradient::Solve(const std::vector<std::vector<double>>& y) {
  SetMatrices();
  std::vector<double> jump(dofs_ * problem_.interface.copies.size());  // Pi M_lambda^-1 (y - F)
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    std::vector<double> nodes = y[e];
    if (!nodes.empty()) workspace_->local[e]->Solve(nodes);
    Collect(e, nodes, &jump);
  }
  average_.Project(&jump);
  const double target = options_.cg_tolerance * std::sqrt(Reduce(jump, jump, jump).rr);
  std::vector<double> x(jump.size()), res = jump;
  iterations_ = 0;
  // The recurrence's residual drifts from the true one, and its step length may lose its sign: begin anew from the true
  // residual as long as that helps.
  double before = std::numeric_limits<double>::infinity();
  for (converged_ = false; !converged_ && iterations_ < options_.cg_max_iterations;) {
    Iterate(target, &x, &res);
    const std::vector<double> product = ApplyInverse(x);
    for (std::size_t i = 0; i < res.size(); ++i) res[i] = jump[i] - product[i];
    const double now = std::sqrt(Reduce(res, res, res).rr);
    converged_ = now <= 2.0 * target;
    if (!(now < 0.5 * before)) break;
    before = now;
  }
  return x;
}

/// Iterates until the recurrence's residual is below the target, the limit is met or the recurrence breaks down.
void AugmentedInterface::ConjugateGradient::Iterate(double target, std::vector<double>* x, std::vector<double>* res) {
  std::vector<double> p(x->size()), s(x->size());
  double rz_before = 0.0, alpha = 0.0;
  for (bool first = true;; first = false, ++iterations_) {
    const std::vector<double> z = Precondition(*res);
    const std::vector<double> w = ApplyInverse(z);
    // Chronopoulos and Gear: z, w = X_lambda z and the three products at once; s = X_lambda p follows by recurrence.
    const Products t = Reduce(*res, z, w);
    if (std::sqrt(t.rr) <= target) return;
    if (iterations_ >= options_.cg_max_iterations || !(t.rz > 0.0)) return;
    const double beta = first ? 0.0 : t.rz / rz_before;
    alpha = t.rz / (first ? t.wz : t.wz - beta * t.rz / alpha);
    if (!(alpha > 0.0)) return;
    rz_before = t.rz;
    for (std::size_t i = 0; i < x->size(); ++i) {
      p[i] = z[i] + beta * p[i];
      s[i] = w[i] + beta * s[i];
      (*x)[i] += alpha * p[i];
      (*res)[i] -= alpha * s[i];
    }
  }
}

}  // namespace nscdd
