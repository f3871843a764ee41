// SPDX-License-Identifier: Apache-2.0
#include "problem/state.h"

#include <algorithm>

#include "problem/contact_frame.h"

namespace nscdd {

void ComputeVelocity(const SubdomainProblem& problem, SubdomainState* state) {
  state->velocity = problem.free_velocity;
  VisitRows(problem, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    constexpr int kDofs = Dofs(Row::kModel), kUnknowns = Unknowns(Row::kModel), kInertias = Inertias(Row::kModel);
    const double* r = state->impulse.data();
    const double* inverse = problem.inverse_mass.data();
    double* v = state->velocity.data();
    for (const Row& c : rows) {
      AddImpulse(c, ImpulseOf<Row>(r), inverse + kInertias * c.a, inverse + kInertias * c.b, v + kDofs * c.a, v + kDofs * c.b);
      r += kUnknowns;
    }
  });
}

PartitionedState InitialState(const PartitionedProblem& problem, std::span<const Vec2> warm) {
  PartitionedState state;
  for (const SubdomainProblem& p : problem.subdomains) {
    SubdomainState& s = state.subdomains.emplace_back();
    s.impulse.assign(Unknowns(p.model) * p.contact_count(), 0.0);
    if (warm.empty()) {
      s.velocity = p.free_velocity;
      continue;
    }
    VisitRows(p, [&](const auto& rows) {
      using Row = typename std::decay_t<decltype(rows)>::value_type;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Vec2 r = warm[p.contact[k]];
        double* impulse = &s.impulse[Unknowns(Row::kModel) * k];
        // The cone of now: friction may have changed, and the impulse may come from a file.
        impulse[0] = std::max(0.0, r.x);
        if constexpr (HasFriction(Row::kModel)) {
          const double bound = rows[k].friction * impulse[0];
          impulse[1] = std::clamp(r.y, -bound, bound);
        }
      }
    });
    ComputeVelocity(p, &s);
  }
  const int dofs = Dofs(problem.model);
  state.interface.impulse.assign(dofs * problem.interface.copies.size(), 0.0);
  return state;
}

void StoreVelocities(const SubdomainProblem& problem, const SubdomainState& state, std::span<const double> inverse_mass,
                     std::vector<Twist>* velocity) {
  const int dofs = Dofs(problem.model);
  for (std::size_t b = 0; b < problem.body_count(); ++b) {
    const std::int32_t row = problem.body[b];
    if (inverse_mass[row] == 0.0) continue;
    const double* v = &state.velocity[dofs * b];
    Twist& out = (*velocity)[row];
    out.vx = v[0];
    out.vy = v[1];
    if (dofs == 3) out.spin = v[2];
  }
}

void StoreImpulses(const SubdomainProblem& problem, const SubdomainState& state, std::vector<Vec2>* impulse,
                   std::vector<Vec2>* relative_velocity) {
  VisitRows(problem, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    constexpr int kDofs = Dofs(Row::kModel), kUnknowns = Unknowns(Row::kModel);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double* r = &state.impulse[kUnknowns * k];
      const Local v = RelativeVelocity(rows[k], &state.velocity[kDofs * rows[k].a], &state.velocity[kDofs * rows[k].b]);
      (*impulse)[problem.contact[k]] = {r[0], kUnknowns == 2 ? r[kUnknowns - 1] : 0.0};
      (*relative_velocity)[problem.contact[k]] = {v.n, v.t};
    }
  });
}

}  // namespace nscdd
