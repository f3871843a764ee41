// SPDX-License-Identifier: Apache-2.0
#include "algorithms/imbalance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "interface/copy_average.h"
#include "parallel/ordered_reduction.h"
#include "problem/contact_frame.h"
#include "problem/state.h"

namespace nscdd {
namespace {

struct Worst {
  double imbalance;
};

/// V_E - V_f - M~_E^-1 H_E r_E of each copy.
std::vector<double> LackOf(const SubdomainProblem& p, const SubdomainState& state) {
  SubdomainState balanced{{}, state.impulse};
  ComputeVelocity(p, &balanced);
  std::vector<double> lack = state.velocity;
  for (std::size_t i = 0; i < lack.size(); ++i) lack[i] -= balanced.velocity[i];
  return lack;
}

/// Means over the copies: sum_E M~_E lack_E / M.
void AverageCopies(const PartitionedProblem& problem, Communicator* communicator, std::vector<std::vector<double>>* lacks) {
  const InterfaceMap& map = problem.interface;
  if (map.copies.empty()) return;
  const int dofs = Dofs(problem.model);
  const auto of_copy = [&](std::size_t k) { return &(*lacks)[map.copies[k].problem][dofs * map.copies[k].body]; };
  std::vector<double> shared(dofs * map.copies.size());
  for (std::size_t k = 0; k < map.copies.size(); ++k) std::copy_n(of_copy(k), dofs, &shared[dofs * k]);
  CopyAverage(map, dofs, communicator).Average(&shared);
  for (std::size_t k = 0; k < map.copies.size(); ++k) std::copy_n(&shared[dofs * k], dofs, of_copy(k));
}

/// Largest |r_c| at each copy [N s].
std::vector<double> LargestImpulses(const SubdomainProblem& p, const SubdomainState& state) {
  std::vector<double> largest(p.body_count());
  VisitRows(p, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    const double* r = state.impulse.data();
    for (const Row& c : rows) {
      const Local impulse = ImpulseOf<Row>(r);
      const double norm = std::hypot(impulse.n, impulse.t);
      for (const std::int32_t copy : {c.a, c.b}) largest[copy] = std::max(largest[copy], norm);
      r += Unknowns(Row::kModel);
    }
  });
  return largest;
}

double WorstOf(const SubdomainProblem& p, const std::vector<double>& lack, const std::vector<double>& largest, double speed) {
  const int dofs = Dofs(p.model);
  double worst = 0.0;
  for (std::size_t i = 0; i < p.body_count(); ++i) {
    const double* inverse = &p.inverse_mass[(dofs - 1) * i];
    if (inverse[0] == 0.0) continue;
    double lack2 = 0.0;
    for (int d = 0; d < dofs; ++d) lack2 += lack[dofs * i + d] * lack[dofs * i + d] * (inverse[0] / inverse[d == 2]);
    if (lack2 == 0.0) continue;
    const double copies = p.multiplicity.empty() ? 1.0 : p.multiplicity[i];
    const double ratio = std::sqrt(lack2) / std::max(speed, largest[i] * inverse[0] / copies);
    if (Exceeds(ratio, worst)) worst = ratio;
  }
  return worst;
}

}  // namespace

double WorstImbalance(const PartitionedProblem& problem, const PartitionedState& state, Communicator* communicator) {
  std::vector<std::vector<double>> lacks;
  for (std::size_t e = 0; e < problem.subdomains.size(); ++e) {
    lacks.push_back(LackOf(problem.subdomains[e], state.subdomains[e]));
  }
  AverageCopies(problem, communicator, &lacks);
  std::vector<ReductionPart<None, Worst>> parts(lacks.size());
  for (std::size_t e = 0; e < lacks.size(); ++e) {
    const SubdomainProblem& p = problem.subdomains[e];
    parts[e].max.imbalance = WorstOf(p, lacks[e], LargestImpulses(p, state.subdomains[e]), problem.scales.velocity);
  }
  return ReduceInOrder(parts, communicator).max.imbalance;
}

}  // namespace nscdd
