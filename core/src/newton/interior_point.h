// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "newton/body_system.h"
#include "nlgs/sweep.h"
#include "problem/state.h"

namespace nscdd {

/// Interior point iterations on the law of each contact as complementary pairs (2D: exact, no linearised cone):
///     0 <= r_n _|_ y = v_n + b_n >= 0;   0 <= p _|_ a_- = mu r_n + r_t >= 0;   0 <= q _|_ a_+ = mu r_n - r_t >= 0;   v_t = p -
///     q
/// (r_n, y only, where mu = 0) with V = V_f + M^-1 H r. Predictor and corrector of Mehrotra (1992) on the residuals
///     R_2 = y - v_n - b_n,   R_3 = p - q - v_t,
/// with a proximal term rho W in the law, centred at the r of now, against the folds that friction makes in the central path;
/// and a mean product that does not fall below |R| (measured in s_c = velocity scale^2 / W_nn, |R| in the velocity scale):
/// where it runs ahead, the contacts' statuses are settled before the impulses have come to where they belong, and steps become
/// short.
struct InteriorPace {
  double floor = 1.0;  ///< the target product is at least floor |R|
  double raise = 4.0;  ///< factor of rho after a step shorter than 0.03
  double lower = 0.5;  ///< factor of rho after a step longer than 0.3
};

template <class Row>
class InteriorPoint {
 public:
  /// `velocity_scale` [m/s] > 0. Sets state to the interior start.
  InteriorPoint(const SubdomainProblem& problem, const std::vector<Row>& rows, double velocity_scale, const InteriorPace& pace,
                BodySystem<Row>* system, SubdomainState* state)
      : problem_(problem), laws_(LawsOf(rows)), scale_(velocity_scale), pace_(pace), system_(system), state_(state) {
    const std::size_t n = rows.size();
    for (auto* list : {&y_, &p_, &q_}) list->assign(n, scale_);
    for (std::size_t c = 0; c < n; ++c) {
      y_[c] = std::max(scale_, laws_[c].offset);
      SetImpulse<Row>(c, {scale_ / laws_[c].wn, 0.0}, &state->impulse);
      pairs_ += laws_[c].mu > 0.0 ? 3 : 1;
    }
    ComputeVelocity(problem_, state_);
    for (auto* list : {&dy_, &dp_, &dq_}) list->assign(n, 0.0);
    r2_.resize(n);
    r3_.resize(n);
    dr_.resize(n);
    right_.resize(n);
    stiffness_.resize(n);
    dv_.resize(system->size());
  }

  /// One factorisation and two or three solves. False: no step is possible (singular to working precision).
  bool Step() {
    const double infeasibility = Residuals();
    const double gamma = MeanProduct(0.0);
    FormStiffness();
    if (!system_->Factorise(stiffness_)) return Regularise();
    SetTargets(0.0, false);
    Solve();
    const double affine = LongestStep(1.0);
    const double ratio = MeanProduct(affine) / gamma;
    double sigma = std::clamp(ratio * ratio * ratio, 1e-6, 0.8);
    if (affine < 0.1) sigma = std::max(sigma, 0.3);
    const double floor = pace_.floor * std::max(0.0, infeasibility - kRounding);
    SetTargets(std::min(2.0 * gamma, std::max(sigma * gamma, floor)), affine >= 0.1);
    Solve();
    const double tau = std::clamp(1.0 - gamma, 0.9, 0.9995);
    const double step = LongestStep(tau);
    if (!std::isfinite(step)) return Regularise();
    Advance(step);
    if (step < 0.03) rho_ = std::min(1.0, pace_.raise * rho_);
    if (step > 0.3) rho_ = std::max(std::min(1e-7, 0.01 * infeasibility), pace_.lower * rho_);
    return true;
  }

  /// |r|_D = (sum W_nn r_n^2 + W_tt r_t^2)^1/2.
  double ImpulseNorm() const {
    double sum = 0.0;
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local r = Impulse(c);
      sum += laws_[c].wn * r.n * r.n + laws_[c].wt * r.t * r.t;
    }
    return std::sqrt(sum);
  }

 private:
  static constexpr double kRounding = 1e-10;  // of |R|: V = V_f + M^-1 H r has no more digits where |r| is large

  bool HasTangent(std::size_t c) const { return HasFriction(Row::kModel) && laws_[c].mu > 0.0; }
  Local Impulse(std::size_t c) const { return ImpulseAt<Row>(state_->impulse, c); }
  double ProductScale(std::size_t c) const { return scale_ * scale_ / laws_[c].wn; }

  bool Regularise() {
    rho_ *= 10.0;
    return rho_ <= 1e3;
  }

  double Residuals() {
    double worst = 0.0;
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local v = system_->Relative(c, state_->velocity);
      r2_[c] = y_[c] - v.n - laws_[c].offset;
      r3_[c] = HasTangent(c) ? p_[c] - q_[c] - v.t : 0.0;
      worst = std::max({worst, std::abs(r2_[c]), std::abs(r3_[c])});
    }
    return worst / scale_;
  }

  /// Mean of the products after a step of length `a`, in their scales.
  double MeanProduct(double a) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local r = Impulse(c), d = dr_[c];
      double products = (r.n + a * d.n) * (y_[c] + a * dy_[c]);
      if (HasTangent(c)) {
        const double mu = laws_[c].mu, rn = r.n + a * d.n, rt = r.t + a * d.t;
        products += (mu * rn + rt) * (p_[c] + a * dp_[c]) + (mu * rn - rt) * (q_[c] + a * dq_[c]);
      }
      sum += products / ProductScale(c);
    }
    return sum / static_cast<double>(pairs_);
  }

  /// E = D^-1, D = [y/r_n + rho W_nn, 0;  mu (p/a_- - q/a_+),  p/a_- + q/a_+ + rho W_tt].
  void FormStiffness() {
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local r = Impulse(c);
      ContactStiffness& e = stiffness_[c];
      e = {};
      e.nn = 1.0 / (y_[c] / r.n + rho_ * laws_[c].wn);
      if (!HasTangent(c)) continue;
      const double mu = laws_[c].mu, minus = p_[c] / (mu * r.n + r.t), plus = q_[c] / (mu * r.n - r.t);
      e.tt = 1.0 / (minus + plus + rho_ * laws_[c].wt);
      e.tn = -mu * (minus - plus) * e.nn * e.tt;
    }
  }

  /// c_1, c_2, c_3: target product less the product of now, less those of the predictor's steps with a corrector. Kept in
  /// dy, dp, dq until Solve().
  void SetTargets(double target, bool corrects) {
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local r = Impulse(c), d = dr_[c];
      const double goal = target * ProductScale(c);
      dy_[c] = goal - r.n * y_[c] - (corrects ? d.n * dy_[c] : 0.0);
      if (!HasTangent(c)) {
        right_[c] = {dy_[c] / r.n + r2_[c], 0.0};
        continue;
      }
      const double mu = laws_[c].mu, minus = mu * r.n + r.t, plus = mu * r.n - r.t;
      dp_[c] = goal - minus * p_[c] - (corrects ? (mu * d.n + d.t) * dp_[c] : 0.0);
      dq_[c] = goal - plus * q_[c] - (corrects ? (mu * d.n - d.t) * dq_[c] : 0.0);
      right_[c] = {dy_[c] / r.n + r2_[c], dp_[c] / minus - dq_[c] / plus + r3_[c]};
    }
  }

  /// (M + H E H^T) dV = H E f,  dr = E (f - H^T dV), refined once on M dV = H dr; then dy, dp, dq.
  void Solve() {
    std::fill(dv_.begin(), dv_.end(), 0.0);
    for (std::size_t c = 0; c < laws_.size(); ++c) system_->AddForce(c, Multiply(stiffness_[c], right_[c]), &dv_);
    system_->Solve(&dv_);
    std::vector<double>& defect = defect_;
    defect.assign(dv_.size(), 0.0);
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local v = system_->Relative(c, dv_);
      dr_[c] = Multiply(stiffness_[c], {right_[c].n - v.n, right_[c].t - v.t});
      system_->AddForce(c, dr_[c], &defect);
    }
    SubtractMomentum(&defect);
    system_->Solve(&defect);
    for (std::size_t i = 0; i < dv_.size(); ++i) dv_[i] += defect[i];
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local v = system_->Relative(c, defect), change = Multiply(stiffness_[c], v);
      dr_[c] = {dr_[c].n - change.n, dr_[c].t - change.t};
      BackSubstitute(c);
    }
  }

  /// defect -= M dV on free bodies.
  void SubtractMomentum(std::vector<double>* defect) const {
    constexpr int kDofs = Dofs(Row::kModel);
    for (std::size_t b = 0; b < problem_.body_count(); ++b) {
      for (int d = 0; d < kDofs; ++d) {
        const double inverse = system_->InverseMass(b, d);
        if (inverse > 0.0) (*defect)[kDofs * b + d] -= dv_[kDofs * b + d] / inverse;
      }
    }
  }

  void BackSubstitute(std::size_t c) {
    const Local r = Impulse(c), d = dr_[c];
    dy_[c] = (dy_[c] - y_[c] * d.n) / r.n;
    if (!HasTangent(c)) return;
    const double mu = laws_[c].mu;
    dp_[c] = (dp_[c] - p_[c] * (mu * d.n + d.t)) / (mu * r.n + r.t);
    dq_[c] = (dq_[c] - q_[c] * (mu * d.n - d.t)) / (mu * r.n - r.t);
  }

  /// The longest step in (0, 1] that leaves all pairs positive, times `tau` if they limit it.
  double LongestStep(double tau) const {
    double longest = 1.0 / tau;
    const auto limit = [&longest](double x, double dx) {
      if (!(dx >= 0.0)) longest = std::min(longest, -x / dx);
    };
    bool finite = true;
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local r = Impulse(c), d = dr_[c];
      finite = finite && std::isfinite(d.n + d.t + dy_[c] + dp_[c] + dq_[c]);
      limit(r.n, d.n);
      limit(y_[c], dy_[c]);
      if (!HasTangent(c)) continue;
      const double mu = laws_[c].mu;
      limit(mu * r.n + r.t, mu * d.n + d.t);
      limit(mu * r.n - r.t, mu * d.n - d.t);
      limit(p_[c], dp_[c]);
      limit(q_[c], dq_[c]);
    }
    return finite ? std::min(1.0, tau * longest) : NAN;
  }

  void Advance(double a) {
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local r = Impulse(c);
      SetImpulse<Row>(c, {r.n + a * dr_[c].n, r.t + a * dr_[c].t}, &state_->impulse);
      y_[c] += a * dy_[c];
      p_[c] += a * dp_[c];
      q_[c] += a * dq_[c];
    }
    ComputeVelocity(problem_, state_);
  }

  const SubdomainProblem& problem_;
  std::vector<ContactLaw<Row>> laws_;
  double scale_;
  InteriorPace pace_;
  BodySystem<Row>* system_;
  SubdomainState* state_;
  std::int64_t pairs_ = 0;
  double rho_ = 1e-2;
  std::vector<double> y_, p_, q_, dy_, dp_, dq_, r2_, r3_, dv_, defect_;
  std::vector<Local> dr_, right_;
  std::vector<ContactStiffness> stiffness_;
};

}  // namespace nscdd
