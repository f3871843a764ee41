// SPDX-License-Identifier: Apache-2.0
#include "nlgs/sweep.h"

#include <vector>

#include "nlgs/local_solve.h"
#include "nlgs/packet_sweep.h"

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

/// One local solve; returns the velocity before it.
template <class Row>
Local SolveContact(const Row& c, const double* inverse_mass, double* velocity, double* impulse) {
  constexpr int kDofs = Dofs(Row::kModel), kUnknowns = Unknowns(Row::kModel), kInertias = Inertias(Row::kModel);
  double* va = velocity + kDofs * c.a;
  double* vb = velocity + kDofs * c.b;
  const Local r = ImpulseOf<Row>(impulse);
  const Local v = RelativeVelocity(c, va, vb);
  const Local next = SolveLocal(c, r, v);
  if (next.n != r.n || next.t != r.t) {
    AddImpulse(c, {next.n - r.n, next.t - r.t}, inverse_mass + kInertias * c.a, inverse_mass + kInertias * c.b, va, vb);
    impulse[0] = next.n;
    if constexpr (kUnknowns == 2) impulse[1] = next.t;
  }
  return v;
}

template <bool kStatistics, class Row>
void SweepRows(const std::vector<Row>& rows, const double* inverse_mass, double* velocity, double* impulse,
               SweepStatistics* s) {
  constexpr int kUnknowns = Unknowns(Row::kModel);
  for (const Row& c : rows) {
    const Local before = ImpulseOf<Row>(impulse);
    SolveContact(c, inverse_mass, velocity, impulse);
    if constexpr (kStatistics) Accumulate(c, before, ImpulseOf<Row>(impulse), s);
    impulse += kUnknowns;
  }
}

template <bool kStatistics>
void SweepAny(const SubdomainProblem& problem, SubdomainState* state, SweepStatistics* s) {
  VisitRows(problem, [&](const auto& rows) {
    SweepRows<kStatistics>(rows, problem.inverse_mass.data(), state->velocity.data(), state->impulse.data(), s);
  });
}

/// Four contacts at once cost about as much as two of the plain loop. In a chain, where each contact shares a body with the
/// one before, packets are nearly empty.
bool AreFilled(const SubdomainProblem& problem) {
  return !problem.packet_begin.empty() && problem.contact_count() > 2 * (problem.packet_begin.size() - 1);
}

template <class Row>
bool SweepInPackets(const SubdomainProblem& problem, const std::vector<Row>& rows, SubdomainState* state) {
  if constexpr (HasArms(Row::kModel)) {
    return false;
  } else {
    const PacketSweep<Row> sweep = PacketSweepHere<Row>();
    if (!sweep || !AreFilled(problem)) return false;
    sweep(rows.data(), problem.packet_begin.data(), problem.packet_begin.size() - 1, problem.inverse_mass.data(),
          state->velocity.data(), state->impulse.data());
    return true;
  }
}

}  // namespace

void Sweep(const SubdomainProblem& problem, SubdomainState* state) {
  const bool done = VisitRows(problem, [&](const auto& rows) { return SweepInPackets(problem, rows, state); });
  if (!done) SweepAny<false>(problem, state, nullptr);
}

SweepStatistics SweepWithStatistics(const SubdomainProblem& problem, SubdomainState* state) {
  SweepStatistics s;
  SweepAny<true>(problem, state, &s);
  return s;
}

SweepStatistics SweepRecording(const SubdomainProblem& problem, SubdomainState* state, std::vector<double>* left) {
  SweepStatistics s;
  left->resize(problem.contact_count());
  VisitRows(problem, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      double* impulse = &state->impulse[Unknowns(Row::kModel) * k];
      const Local before = ImpulseOf<Row>(impulse);
      const Local v = SolveContact(rows[k], problem.inverse_mass.data(), state->velocity.data(), impulse);
      const Local after = ImpulseOf<Row>(impulse);
      Accumulate(rows[k], before, after, &s);
      (*left)[k] = v.t + Multiply(Block(rows[k]), {after.n - before.n, after.t - before.t}).t;
    }
  });
  return s;
}

void SweepSome(const SubdomainProblem& problem, const std::vector<std::int32_t>& positions, SubdomainState* state) {
  VisitRows(problem, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    for (const std::int32_t k : positions) {
      SolveContact(rows[k], problem.inverse_mass.data(), state->velocity.data(), &state->impulse[Unknowns(Row::kModel) * k]);
    }
  });
}

}  // namespace nscdd
