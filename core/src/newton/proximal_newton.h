// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "newton/body_system.h"
#include "nlgs/residual.h"
#include "nlgs/sweep.h"
#include "problem/state.h"

namespace nscdd {

/// Proximal point iterations on r, each solved by a semismooth Newton method in V. With centre r_k and kappa = 1 / (rho W_cc),
///     G(V) = M (V - V_f) - H P(r_k - kappa (v + (b_n, 0))) = 0,   P(z) = (max(0, z_n), clamp(z_t, +-mu P_n))
/// Newton matrix M + H K H^T with the exact, unsymmetric K of sliding contacts (dr_t = +-mu dr_n). Backtracking on |G|_{M^-1}.
template <class Row>
class ProximalNewton {
 public:
  /// Starts from the impulses in `state`.
  ProximalNewton(const SubdomainProblem& problem, const std::vector<Row>& rows, double rho, BodySystem<Row>* system,
                 SubdomainState* state)
      : problem_(problem),
        laws_(LawsOf(rows)),
        rho_(rho),
        system_(system),
        state_(state),
        centre_(state->impulse),
        stiffness_(rows.size()) {}

  /// One proximal step of at most `budget` factorisations, at least one. Where the inner iteration fails and the worst natural
  /// residual has not fallen, or it is ten times the best one, the state is that of before and rho is doubled: at the level of
  /// rounding, which 1 / rho multiplies, residuals would grow without end. False: no step is possible.
  bool Step(int budget, int* factorisations) {
    const SubdomainState before = *state_;
    const bool solved = SolveInner(std::min(20, budget), factorisations);
    TakeImpulses();
    const double was = Worst(before), is = Worst(*state_);
    best_ = std::min(best_, was);
    if ((!solved && !(is < was)) || !(is <= 10.0 * best_)) {
      *state_ = before;
      centre_ = state_->impulse;
      rho_ *= 2.0;
      return rho_ <= 1e3;
    }
    if (*factorisations < 8) rho_ = std::max(1e-8, 0.7 * rho_);
    Overrelax();
    return true;
  }

 private:
  double Worst(const SubdomainState& state) const { return NaturalResidual(problem_, state).worst; }

  /// Newton iterations until |G| has fallen to a hundredth; false where it has not.
  bool SolveInner(int most, int* factorisations) {
    double norm = Residual(state_->velocity);
    const double goal = 1e-2 * norm;
    for (*factorisations = 0; *factorisations == 0 || norm > goal;) {
      if (*factorisations == most) return false;
      ++*factorisations;
      if (!system_->Factorise(stiffness_)) return false;
      direction_ = g_;
      for (double& x : direction_) x = -x;
      system_->Solve(&direction_);
      const double next = Search(norm);
      if (!(next < norm)) return false;
      norm = next;
    }
    return true;
  }

  Local Projected(std::size_t c, const std::vector<double>& velocity, ContactStiffness* k) const {
    const ContactLaw<Row>& law = laws_[c];
    const Local centre = ImpulseAt<Row>(centre_, c), v = system_->Relative(c, velocity);
    const double kn = 1.0 / (rho_ * law.wn);
    const double zn = centre.n - kn * (v.n + law.offset);
    *k = {};
    if (!(zn > 0.0)) return {zn <= 0.0 ? 0.0 : zn, 0.0};  // not a number stays
    k->nn = kn;
    if (law.mu == 0.0) return {zn, 0.0};
    const double kt = 1.0 / (rho_ * law.wt), zt = centre.t - kt * v.t, bound = law.mu * zn;
    if (std::abs(zt) <= bound) {
      k->tt = kt;
      return {zn, zt};
    }
    k->tn = std::copysign(law.mu * kn, zt);
    return {zn, std::copysign(bound, zt)};
  }

  /// Sets G and K at `velocity`; |G| in the norm of M^-1.
  double Residual(const std::vector<double>& velocity) {
    constexpr int kDofs = Dofs(Row::kModel);
    g_.assign(velocity.size(), 0.0);
    for (std::size_t c = 0; c < laws_.size(); ++c) system_->AddForce(c, Projected(c, velocity, &stiffness_[c]), &g_);
    double sum = 0.0;
    for (std::size_t b = 0; b < problem_.body_count(); ++b) {
      for (int d = 0; d < kDofs; ++d) {
        const std::size_t i = kDofs * b + d;
        const double inverse = system_->InverseMass(b, d);
        if (inverse == 0.0) continue;
        g_[i] = (velocity[i] - problem_.free_velocity[i]) / inverse - g_[i];
        sum += inverse * g_[i] * g_[i];
      }
    }
    return std::sqrt(sum);
  }

  /// Halves the step until |G| falls; the state's velocity and G, K follow. Returns |G|.
  double Search(double norm) {
    const std::vector<double> start = state_->velocity;
    double step = 1.0, next = norm;
    for (int halvings = 0; halvings <= 8; ++halvings, step *= 0.5) {
      for (std::size_t i = 0; i < start.size(); ++i) state_->velocity[i] = start[i] + step * direction_[i];
      next = Residual(state_->velocity);
      if (next < norm) return next;
    }
    state_->velocity = start;
    Residual(start);
    return norm;
  }

  /// r := P(...), V := V_f + M^-1 H r.
  void TakeImpulses() {
    ContactStiffness unused;
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      SetImpulse<Row>(c, Projected(c, state_->velocity, &unused), &state_->impulse);
    }
    ComputeVelocity(problem_, state_);
  }

  /// Next centre r_k + 1.8 (r - r_k), clipped to the cone.
  void Overrelax() {
    for (std::size_t c = 0; c < laws_.size(); ++c) {
      const Local old = ImpulseAt<Row>(centre_, c), r = ImpulseAt<Row>(state_->impulse, c);
      Local next{std::max(0.0, old.n + 1.8 * (r.n - old.n)), 0.0};
      const double bound = laws_[c].mu * next.n;
      next.t = std::clamp(old.t + 1.8 * (r.t - old.t), -bound, bound);
      SetImpulse<Row>(c, next, &centre_);
    }
  }

  const SubdomainProblem& problem_;
  std::vector<ContactLaw<Row>> laws_;
  double rho_;
  double best_ = INFINITY;  // worst natural residual of the best state [m/s]
  BodySystem<Row>* system_;
  SubdomainState* state_;
  std::vector<double> centre_;
  std::vector<ContactStiffness> stiffness_;
  std::vector<double> g_, direction_;
};

}  // namespace nscdd
