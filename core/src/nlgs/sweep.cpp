#include "nlgs/sweep.h"

#include <vector>

#include "nlgs/local_solve.h"

namespace nscdd {
namespace {

template <class Row>
Delassus Block(const Row& c) {
  if constexpr (Row::kModel == ContactModel::kFrictionArms) {
    return {c.wnn, c.wnt, c.wtt};
  } else if constexpr (Row::kModel == ContactModel::kFriction) {
    return {1.0 / c.inverse_wnn, 0.0, 1.0 / c.inverse_wtt};
  } else {
    return {1.0 / c.inverse_wnn, 0.0, 0.0};
  }
}

Local Multiply(const Delassus& w, Local r) { return {w.nn * r.n + w.nt * r.t, w.nt * r.n + w.tt * r.t}; }
double Dot(Local a, Local b) { return a.n * b.n + a.t * b.t; }

template <class Row>
void Accumulate(const Row& c, Local before, Local after, SweepStatistics* s) {
  const Local mean{0.5 * (before.n + after.n), 0.5 * (before.t + after.t)};
  if (mean.n == 0.0 && mean.t == 0.0) return;
  const Delassus w = Block(c);
  const Local dv = Multiply(w, {after.n - before.n, after.t - before.t});
  const Local w0 = Multiply(w, before), w1 = Multiply(w, after);
  const double dv2 = Dot(dv, dv), r2 = Dot(mean, mean);
  ++s->active;
  s->sum_dv2 += dv2;
  s->sum_dv2_r2 += dv2 * r2;
  s->sum_rwr += 0.5 * (Dot(before, w0) + Dot(after, w1));
  s->sum_wr2 += 0.5 * (Dot(w0, w0) + Dot(w1, w1));
  s->max_dv = std::max(s->max_dv, std::sqrt(dv2));
  s->max_dv_r = std::max(s->max_dv_r, std::sqrt(dv2 * r2));
}

template <bool kStatistics, class Row>
void SweepRows(const std::vector<Row>& rows, const double* inverse_mass, double* velocity, double* impulse, SweepStatistics* s) {
  constexpr int kDofs = Dofs(Row::kModel), kUnknowns = Unknowns(Row::kModel), kInertias = Inertias(Row::kModel);
  for (const Row& c : rows) {
    double* va = velocity + kDofs * c.a;
    double* vb = velocity + kDofs * c.b;
    Local r{impulse[0], 0.0};
    if constexpr (kUnknowns == 2) r.t = impulse[1];
    const Local next = SolveLocal(c, r, RelativeVelocity(c, va, vb));
    if (next.n != r.n || next.t != r.t) {
      AddImpulse(c, {next.n - r.n, next.t - r.t}, inverse_mass + kInertias * c.a, inverse_mass + kInertias * c.b, va, vb);
      impulse[0] = next.n;
      if constexpr (kUnknowns == 2) impulse[1] = next.t;
    }
    if constexpr (kStatistics) Accumulate(c, r, next, s);
    impulse += kUnknowns;
  }
}

template <bool kStatistics>
void SweepAny(const SubdomainProblem& problem, SubdomainState* state, SweepStatistics* s) {
  VisitRows(problem, [&](const auto& rows) {
    SweepRows<kStatistics>(rows, problem.inverse_mass.data(), state->velocity.data(), state->impulse.data(), s);
  });
}

}  // namespace

void Sweep(const SubdomainProblem& problem, SubdomainState* state) { SweepAny<false>(problem, state, nullptr); }

SweepStatistics SweepWithStatistics(const SubdomainProblem& problem, SubdomainState* state) {
  SweepStatistics s;
  SweepAny<true>(problem, state, &s);
  return s;
}

void ComputeVelocity(const SubdomainProblem& problem, SubdomainState* state) {
  state->velocity = problem.free_velocity;
  VisitRows(problem, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    constexpr int kDofs = Dofs(Row::kModel), kUnknowns = Unknowns(Row::kModel), kInertias = Inertias(Row::kModel);
    const double* r = state->impulse.data();
    const double* inverse = problem.inverse_mass.data();
    double* v = state->velocity.data();
    for (const Row& c : rows) {
      const Local impulse{r[0], kUnknowns == 2 ? r[kUnknowns - 1] : 0.0};
      AddImpulse(c, impulse, inverse + kInertias * c.a, inverse + kInertias * c.b, v + kDofs * c.a, v + kDofs * c.b);
      r += kUnknowns;
    }
  });
}

}  // namespace nscdd
