// SPDX-License-Identifier: Apache-2.0
#include "algorithms/anderson.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "parallel/ordered_reduction.h"
#include "problem/state.h"

namespace nscdd {
namespace {

/// No start lies further from g than so many |f|, times the ratio of the largest to the smallest mass. A self-stress
/// (H s = 0) changes no velocity: f does not see it, and coefficients that are right for f may move along it without bound.
/// Acceleration needs about 1 / (1 - rate of the sweeps); the rate nears 1 with the length of chains and the ratio of masses.
constexpr double kReach = 2e3;

/// sum term(k), k < n, by four partial sums in an order that is the same on every machine.
template <class Term>
double Sum(std::size_t n, Term term) {
  double s[4] = {};
  std::size_t k = 0;
  for (; k + 4 <= n; k += 4) {
    for (int i = 0; i < 4; ++i) s[i] += term(k + i);
  }
  for (; k < n; ++k) s[0] += term(k);
  return (s[0] + s[1]) + (s[2] + s[3]);
}

double Dot(const double* a, const double* b, std::size_t n) {
  return Sum(n, [=](std::size_t k) { return a[k] * b[k]; });
}

/// f := g - s and df := f - (f before), weighted := weight df; the vectors do not overlap.
void Subtract(std::size_t n, const double* __restrict g, const double* __restrict s, const double* __restrict weight,
              double* __restrict f, double* __restrict df, double* __restrict weighted) {
  for (std::size_t k = 0; k < n; ++k) {
    const double now = g[k] - s[k];
    const double difference = now - f[k];
    f[k] = now;
    df[k] = difference;
    weighted[k] = weight[k] * difference;
  }
}

double WeightedNorm2(const double* weight, const double* f, std::size_t n) {
  return Sum(n, [=](std::size_t k) { return weight[k] * f[k] * f[k]; });
}

double WeightedDistance2(const double* weight, const double* a, const double* b, std::size_t n) {
  return Sum(n, [=](std::size_t k) { return weight[k] * (a[k] - b[k]) * (a[k] - b[k]); });
}

template <class Row>
void AppendWeights(const std::vector<Row>& rows, std::vector<double>* weight) {
  for (const Row& c : rows) {
    if constexpr (Row::kModel == ContactModel::kFrictionArms) {
      weight->insert(weight->end(), {c.wnn, c.wtt});
    } else if constexpr (Row::kModel == ContactModel::kFriction) {
      weight->insert(weight->end(), {1.0 / c.inverse_wnn, 1.0 / c.inverse_wtt});
    } else {
      weight->push_back(1.0 / c.inverse_wnn);
    }
  }
}

/// |r_t| <= mu r_n, r_n >= 0.
template <class Row>
void ClipToCones(const std::vector<Row>& rows, double* impulse) {
  for (const Row& c : rows) {
    impulse[0] = std::max(0.0, impulse[0]);
    if constexpr (HasFriction(Row::kModel)) {
      const double bound = c.friction * impulse[0];
      impulse[1] = std::min(bound, std::max(-bound, impulse[1]));
    }
    impulse += Unknowns(Row::kModel);
  }
}

}  // namespace

Anderson::Anderson(const PartitionedProblem& problem, const AccelerationOptions& options, const Gluing* gluing,
                   Communicator* communicator, const PartitionedState& start)
    : problem_(problem), gluing_(gluing), communicator_(communicator), every_(options.every) {
  if (options.method == Acceleration::kNone) return;
  depth_ = options.depth;
  parts_.resize(problem.subdomains.size());
  for (std::size_t k = 0; k < problem.interface.copies.size(); ++k) {
    parts_[problem.interface.copies[k].problem].copies.push_back(static_cast<std::int32_t>(k));
  }
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    MakePart(e);
    Pack(e, start, parts_[e].start.data());
  }
}

void Anderson::MakePart(std::size_t e) {
  const SubdomainProblem& p = problem_.subdomains[e];
  const int dofs = Dofs(p.model);
  Part& part = parts_[e];
  VisitRows(p, [&](const auto& rows) { AppendWeights(rows, &part.weight); });
  for (const std::int32_t k : part.copies) {
    const double* inverse = &p.inverse_mass[(dofs - 1) * problem_.interface.copies[k].body];
    for (int d = 0; d < dofs; ++d) part.weight.push_back(inverse[d == 2]);
  }
  for (std::size_t i = 0; (dofs - 1) * i < p.inverse_mass.size(); ++i) {
    const double share = p.multiplicity.empty() ? 1.0 : p.multiplicity[i];
    const double inverse = p.inverse_mass[(dofs - 1) * i] / share;
    if (inverse == 0.0) continue;
    part.masses = {std::max(part.masses.largest, 1.0 / inverse), std::max(part.masses.largest_inverse, inverse)};
  }
  const std::size_t n = part.weight.size();
  part.start.resize(n);
  part.residual.resize(n);
  part.weighted.resize(n);
  part.images.resize((depth_ + 1) * n);
  part.differences.resize(depth_ * n);
}

void Anderson::Pack(std::size_t e, const PartitionedState& state, double* out) const {
  const std::vector<double>& impulse = state.subdomains[e].impulse;
  out = std::copy(impulse.begin(), impulse.end(), out);
  const int dofs = Dofs(problem_.model);
  for (const std::int32_t k : parts_[e].copies) out = std::copy_n(&state.interface.impulse[dofs * k], dofs, out);
}

void Anderson::Unpack(std::size_t e, PartitionedState* state) const {
  const std::vector<double>& start = parts_[e].start;
  SubdomainState& s = state->subdomains[e];
  std::copy_n(start.begin(), s.impulse.size(), s.impulse.begin());
  const double* in = start.data() + s.impulse.size();
  const int dofs = Dofs(problem_.model);
  for (const std::int32_t k : parts_[e].copies) {
    std::copy_n(in, dofs, &state->interface.impulse[dofs * k]);
    in += dofs;
  }
  ComputeVelocity(problem_.subdomains[e], &s);
}

Anderson::Products Anderson::TakeImage(const PartitionedState& state) {
  // The slot that the newest df will have if it is kept: Keep() moves newest_ there. The first residual has no df.
  const int slot = has_residual_ ? (newest_ + 1) % depth_ : newest_;
  image_ = (image_ + 1) % (depth_ + 1);
  std::vector<ReductionPart<Products, Masses>> sums(parts_.size());
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    Part& part = parts_[e];
    const std::size_t n = part.weight.size();
    double* g = part.images.data() + image_ * n;
    double* df = part.differences.data() + slot * n;
    // f and df in one pass; `weighted` holds weight df, so that each product below reads two vectors and not three.
    Pack(e, state, g);
    Subtract(n, g, part.start.data(), part.weight.data(), part.residual.data(), df, part.weighted.data());
    const int kept = has_residual_ ? std::min(count_ + 1, depth_) : 0;
    for (int age = 0; age < kept; ++age) {
      const int other = (slot + depth_ - age) % depth_;
      sums[e].sum.df_df[age] = Dot(part.weighted.data(), part.differences.data() + other * n, n);
    }
    const double* before = part.images.data() + ImageSlot(1) * n;
    if (has_residual_) sums[e].sum.dg_dg = WeightedDistance2(part.weight.data(), g, before, n);
    sums[e].sum.df_f = Dot(part.weighted.data(), part.residual.data(), n);
    sums[e].sum.f_f = WeightedNorm2(part.weight.data(), part.residual.data(), n);
    sums[e].max = part.masses;
  }
  const auto all = ReduceInOrder(sums, communicator_);
  reach_ = kReach * all.max.largest * all.max.largest_inverse;
  return all.sum;
}

void Anderson::Keep(const Products& products) {
  newest_ = (newest_ + 1) % depth_;
  count_ = std::min(count_ + 1, depth_);
  // <df_i, f> of the older i changes by <df_i, df>, since f has: no vector is read again.
  for (int age = 0; age < count_; ++age) {
    const int other = Slot(age);
    gram_[newest_][other] = gram_[other][newest_] = products.df_df[age];
    moments_[other] += products.df_df[age];  // <f + df, df_i>
  }
  moments_[newest_] = products.df_f;
  length_[newest_] = std::sqrt(products.dg_dg);
}

void Anderson::Restart() {
  count_ = 0;
  ++restarts_;
}

/// (D^T D + 1e-10 tr(D^T D) I) c = D^T f,  D = [df_i], newest first; c is shortened so that sum |c_i| |dg_i| <= reach |f|.
std::vector<double> Anderson::Coefficients() const {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxDepth, kMaxDepth>;
  Matrix normal(count_, count_);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxDepth, 1> c(count_);
  for (int i = 0; i < count_; ++i) {
    for (int j = 0; j < count_; ++j) normal(i, j) = gram_[Slot(i)][Slot(j)];
    c(i) = moments_[Slot(i)];
  }
  // Differences may be nearly parallel, above all with small residuals.
  normal.diagonal().array() += 1e-10 * normal.trace();
  normal.ldlt().solveInPlace(c);
  double path = 0.0;
  for (int i = 0; i < count_; ++i) path += std::abs(c(i)) * length_[Slot(i)];
  const double reach = reach_ * std::sqrt(norm2_);
  if (path > reach) c *= reach / path;
  return {c.data(), c.data() + count_};
}

/// start := g - sum c_i dg_i, written as a combination of the g.
void Anderson::Combine(Part* part, const std::vector<double>& c) const {
  const std::size_t n = part->weight.size();
  std::vector<double>& s = part->start;
  const double* g = part->images.data() + image_ * n;
  const double first = c.empty() ? 1.0 : 1.0 - c.front();
  for (std::size_t k = 0; k < n; ++k) s[k] = first * g[k];
  // dg_i = g_i - g_(i+1), newest first: the coefficient of g_i is c_i less the one before it.
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double a = c[i] - (i + 1 < c.size() ? c[i + 1] : 0.0);
    g = part->images.data() + ImageSlot(static_cast<int>(i) + 1) * n;
    for (std::size_t k = 0; k < n; ++k) s[k] += a * g[k];
  }
}

void Anderson::Extrapolate(int iteration, PartitionedState* state, double scale) {
  if (depth_ == 0 || iteration % every_ != 0) return;
  // Safeguard first: a residual that has grown says that the differences mislead.
  const Products products = TakeImage(*state);
  if (has_residual_) {
    if (products.f_f <= norm2_) {
      Keep(products);
    } else if (count_ > 0) {
      Restart();
    }
  }
  has_residual_ = true;
  norm2_ = products.f_f;
  const bool extrapolates = count_ > 0;
  const std::vector<double> c = extrapolates ? Coefficients() : std::vector<double>{};
  // Without differences the next start is the image itself, which `state` is already.
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    Combine(&parts_[e], c);
    if (!extrapolates && scale == 1.0) continue;
    for (double& s : parts_[e].start) s *= scale;
    VisitRows(problem_.subdomains[e], [&](const auto& rows) { ClipToCones(rows, parts_[e].start.data()); });
    Unpack(e, state);
  }
  if (!extrapolates && scale == 1.0) return;
  ++extrapolations_;
  gluing_->SubtractImpulse(state->interface, &state->subdomains);
}

SolveReport Anderson::Close(SolveReport report) const {
  report.extrapolations += extrapolations_;
  report.acceleration_restarts += restarts_;
  return report;
}

}  // namespace nscdd
