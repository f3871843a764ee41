// SPDX-License-Identifier: Apache-2.0
#include "interface/gluing.h"

#include <algorithm>
#include <utility>

namespace nscdd {

Gluing::Gluing(const std::vector<SubdomainProblem>& problems, const InterfaceMap& map, Communicator* communicator)
    : problems_(problems),
      map_(map),
      dofs_(problems.empty() ? 0 : Dofs(problems.front().model)),
      average_(map, dofs_, communicator),
      mean_(dofs_ * map.copies.size()) {}

void Gluing::Measure(const std::vector<SubdomainState>& states, std::vector<JumpPart>* jumps) {
  jumps->assign(problems_.size(), {});
  if (map_.copies.empty()) return;
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    const auto& copy = map_.copies[k];
    std::copy_n(&states[copy.problem].velocity[dofs_ * copy.body], dofs_, &mean_[dofs_ * k]);
  }
  average_.Average(&mean_);
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    const auto& copy = map_.copies[k];
    const double* v = &states[copy.problem].velocity[dofs_ * copy.body];
    const double* inverse = &problems_[copy.problem].inverse_mass[(dofs_ - 1) * copy.body];
    JumpPart& jump = (*jumps)[copy.problem];
    for (int d = 0; d < dofs_; ++d) {
      const double dv = v[d] - mean_[dofs_ * k + d];
      jump.sum_squares += dv * dv * (inverse[0] / inverse[d == 2]);  // I / m = (1/m) / (1/I) for the spin, 1 for translations
    }
    jump.copies += 1.0;
  }
}

void Gluing::Glue(std::vector<SubdomainState>* states, InterfaceState* interface) const {
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    const auto& copy = map_.copies[k];
    double* v = &(*states)[copy.problem].velocity[dofs_ * copy.body];
    const double* inverse = &problems_[copy.problem].inverse_mass[(dofs_ - 1) * copy.body];
    for (int d = 0; d < dofs_; ++d) {
      interface->impulse[dofs_ * k + d] += (v[d] - mean_[dofs_ * k + d]) / inverse[d == 2];
      v[d] = mean_[dofs_ * k + d];
    }
  }
}

void Gluing::SwapMeans(std::vector<SubdomainState>* states) {
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    const auto& copy = map_.copies[k];
    std::swap_ranges(&mean_[dofs_ * k], &mean_[dofs_ * k] + dofs_, &(*states)[copy.problem].velocity[dofs_ * copy.body]);
  }
}

void Gluing::SubtractImpulse(const InterfaceState& interface, std::vector<SubdomainState>* states) const {
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    const auto& copy = map_.copies[k];
    double* v = &(*states)[copy.problem].velocity[dofs_ * copy.body];
    const double* inverse = &problems_[copy.problem].inverse_mass[(dofs_ - 1) * copy.body];
    for (int d = 0; d < dofs_; ++d) v[d] -= inverse[d == 2] * interface.impulse[dofs_ * k + d];
  }
}

}  // namespace nscdd
