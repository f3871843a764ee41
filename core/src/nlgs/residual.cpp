// SPDX-License-Identifier: Apache-2.0
#include "nlgs/residual.h"

#include <algorithm>
#include <cmath>

#include "nscdd/natural_residual.h"
#include "parallel/ordered_reduction.h"
#include "problem/contact_frame.h"

namespace nscdd {
namespace {

template <class Row>
double Friction(const Row& c) {
  if constexpr (HasFriction(Row::kModel)) return c.friction;
  return 0.0;
}

/// Impulses so near the edge of the cone slide; v_t is not small there because r_t is rounded.
constexpr double kEdge = 0.01;

/// p_c of residual.h [J].
double ViolatedPower(const Delassus& w, double u, double mu, Local r, Local v) {
  const double normal = u < 0.0 ? -u * Larger(r.n, -u / w.nn) : u * r.n;
  return normal + r.t * v.t + mu * r.n * std::abs(v.t);
}

/// Adds one contact; returns its error in velocity units.
double AddContact(const Delassus& w, double offset, double mu, Local r, Local v, NaturalParts* parts) {
  const NaturalError error = NaturalErrorOf(w, offset, mu, {r.n, r.t}, {v.n, v.t});
  const double gap_speed = v.n + offset;
  const bool slides = std::abs(r.t) >= (1.0 - kEdge) * mu * r.n;
  parts->sum_e2 += error.e2;
  parts->sum_r2 += r.n * r.n + r.t * r.t;
  parts->sum_power += ViolatedPower(w, gap_speed, mu, r, v);
  parts->sum_load += r.n * gap_speed + r.t * v.t + (slides ? mu * r.n * std::abs(v.t) : 0.0);
  return error.speed;
}

/// Calls visit(k, row, W, r, v) for each contact, W of whole masses where `kShared`.
template <bool kShared, class Row, class Visit>
void VisitContacts(const SubdomainProblem& p, const std::vector<Row>& rows, const SubdomainState& state, Visit visit) {
  constexpr int kDofs = Dofs(Row::kModel), kUnknowns = Unknowns(Row::kModel), kInertias = Inertias(Row::kModel);
  const double* impulse = state.impulse.data();
  for (std::size_t k = 0; k < rows.size(); ++k, impulse += kUnknowns) {
    const Row& c = rows[k];
    // Whole masses from divided ones: 1/M = (m_i/M) / m_i.
    const double share_a = kShared ? 1.0 / p.multiplicity[c.a] : 1.0;
    const double share_b = kShared ? 1.0 / p.multiplicity[c.b] : 1.0;
    const Delassus w = DelassusBlock(c, &p.inverse_mass[kInertias * c.a], &p.inverse_mass[kInertias * c.b], share_a, share_b);
    const Local v = RelativeVelocity(c, &state.velocity[kDofs * c.a], &state.velocity[kDofs * c.b]);
    const Local r{impulse[0], kUnknowns == 2 ? impulse[kUnknowns - 1] : 0.0};
    visit(k, c, w, r, v);
  }
}

template <bool kShared, class Row>
void AddRows(const SubdomainProblem& p, const std::vector<Row>& rows, const SubdomainState& state, NaturalParts* parts) {
  VisitContacts<kShared>(p, rows, state, [&](std::size_t k, const Row& c, const Delassus& w, Local r, Local v) {
    const double error = AddContact(w, c.offset, Friction(c), r, v, parts);
    if (Exceeds(error, parts->worst)) {
      parts->worst = error;
      parts->worst_contact = p.contact[k];
    }
  });
}

/// |V - V_f|_M^2 and the mass; copies that agree add up to their body.
void AddBodies(const SubdomainProblem& p, const SubdomainState& state, NaturalParts* parts) {
  const int dofs = Dofs(p.model);
  for (std::size_t i = 0; i < p.body_count(); ++i) {
    const double* inverse = &p.inverse_mass[(dofs - 1) * i];
    if (inverse[0] == 0.0) continue;
    parts->sum_mass += 1.0 / inverse[0];
    parts->sum_x += (state.velocity[dofs * i] - p.free_velocity[dofs * i]) / inverse[0];
    parts->sum_y += (state.velocity[dofs * i + 1] - p.free_velocity[dofs * i + 1]) / inverse[0];
    for (int d = 0; d < dofs; ++d) {
      const double change = state.velocity[dofs * i + d] - p.free_velocity[dofs * i + d];
      parts->sum_change += change * change / inverse[d == 2];
    }
  }
}

}  // namespace

NaturalParts NaturalResidual(const SubdomainProblem& problem, const SubdomainState& state, Masses masses) {
  NaturalParts parts;
  VisitRows(problem, [&](const auto& rows) {
    if (problem.multiplicity.empty() || masses == Masses::kDivided) {
      AddRows<false>(problem, rows, state, &parts);
    } else {
      AddRows<true>(problem, rows, state, &parts);
    }
  });
  AddBodies(problem, state, &parts);
  return parts;
}

std::vector<double> ViolatedPowers(const SubdomainProblem& problem, const SubdomainState& state) {
  std::vector<double> powers(problem.contact_count());
  VisitRows(problem, [&](const auto& rows) {
    VisitContacts<false>(problem, rows, state, [&](std::size_t k, const auto& c, const Delassus& w, Local r, Local v) {
      powers[k] = ViolatedPower(w, v.n + c.offset, Friction(c), r, v);
    });
  });
  return powers;
}

double Nat(double sum_e2, double sum_r2, const ResidualScales& scales) { return Nat(sum_e2, sum_r2, scales.impulse); }

double NatMax(double worst, const ResidualScales& scales) { return NatMax(worst, scales.velocity); }

double ChangeEnergy(const NaturalParts& parts, const ResidualScales& scales) {
  return Larger(parts.sum_change, 1e-6 * scales.exchange);
}

double ImpulseScale(const NaturalParts& parts, const ResidualScales& scales) {
  return std::sqrt(ChangeEnergy(parts, scales) * parts.sum_mass);
}

void SetNatural(const NaturalParts& parts, const ResidualScales& scales, Residuals* residuals) {
  residuals->nat = Nat(parts.sum_e2, parts.sum_r2, scales);
  residuals->nat_max = NatMax(parts.worst, scales);
  const double change = ChangeEnergy(parts, scales);
  const auto over_change = [&](double sum) { return sum == 0.0 ? 0.0 : sum / change; };
  residuals->power = over_change(parts.sum_power);
  residuals->load_error = std::abs(over_change(parts.sum_load));
  // Before the loads arrive E is small: the whole of what loads can do is the scale then.
  const double scale = std::sqrt(Larger(change, scales.exchange) * parts.sum_mass);
  residuals->wall_error = 3.0 * (residuals->load_error + residuals->power) * scale;
}

StagnationMeasures Stagnation(const SweepStatistics& s, const ResidualScales& scales) {
  StagnationMeasures m;
  if (s.active == 0 || s.sum_rwr <= 1e-18 * scales.energy) return m;
  const double na = static_cast<double>(s.active);
  const double mean_rwr = s.sum_rwr / na;
  m.quad_wr = std::sqrt(s.sum_wr2 / na);
  m.quad = std::max(std::sqrt(s.sum_dv2 / na) / m.quad_wr, std::sqrt(s.sum_dv2_r2 / na) / mean_rwr);
  m.maxm = std::max(s.max_dv / m.quad_wr, s.max_dv_r / mean_rwr);
  m.qm16 = std::max(m.quad, m.maxm / 16.666);
  return m;
}

double Measure(Criterion criterion, const Residuals& residuals) {
  switch (criterion) {
    case Criterion::kNat:
      return residuals.nat;
    case Criterion::kNatMax:
      return residuals.nat_max;
    case Criterion::kQuad:
      return residuals.quad;
    case Criterion::kMaxm:
      return residuals.maxm;
    case Criterion::kQm16:
      break;
  }
  return residuals.qm16;
}

Bounds BoundsOf(const StoppingOptions& options) {
  if (options.criterion != Criterion::kNat && options.criterion != Criterion::kNatMax) return {1.0, INFINITY};
  const double load_error = std::clamp(8.0 * options.tolerance, 0.008, 0.08);
  return {std::min(1.0, 25.0 * load_error), load_error};
}

double Measure(const StoppingOptions& options, const Residuals& residuals) {
  const double criterion = Measure(options.criterion, residuals);
  if (options.tolerance == 0.0) return criterion;
  const Bounds bounds = BoundsOf(options);
  const double beside = Larger(residuals.power / bounds.power, residuals.load_error / bounds.load_error);
  return Larger(criterion, options.tolerance * beside);
}

}  // namespace nscdd
