#include "interface/gluing.h"

namespace nscdd {

Gluing::Gluing(const std::vector<SubdomainProblem>& problems, const InterfaceMap& map, Communicator* communicator)
    : problems_(problems),
      map_(map),
      communicator_(communicator),
      dofs_(problems.empty() ? 0 : Dofs(problems.front().model)),
      slots_(dofs_ * map.slot_count()) {
  for (const auto& neighbour : map.neighbours) {
    send_.emplace_back(dofs_ * neighbour.send.size());
    receive_.emplace_back(dofs_ * neighbour.receive.size());
  }
}

void Gluing::FillSlots(const std::vector<SubdomainState>& states) {
  for (const auto& copy : map_.copies) {
    const double* v = &states[copy.problem].velocity[dofs_ * copy.body];
    for (int d = 0; d < dofs_; ++d) slots_[dofs_ * copy.slot + d] = v[d];
  }
  if (map_.neighbours.empty()) return;
  std::vector<Communicator::Outgoing> outgoing;
  std::vector<Communicator::Incoming> incoming;
  for (std::size_t i = 0; i < map_.neighbours.size(); ++i) {
    double* out = send_[i].data();
    for (const std::int32_t slot : map_.neighbours[i].send) {
      for (int d = 0; d < dofs_; ++d) *out++ = slots_[dofs_ * slot + d];
    }
    outgoing.push_back({map_.neighbours[i].rank, send_[i]});
    incoming.push_back({map_.neighbours[i].rank, receive_[i]});
  }
  communicator_->Exchange(outgoing, incoming);
  for (std::size_t i = 0; i < map_.neighbours.size(); ++i) {
    const double* in = receive_[i].data();
    for (const std::int32_t slot : map_.neighbours[i].receive) {
      for (int d = 0; d < dofs_; ++d) slots_[dofs_ * slot + d] = *in++;
    }
  }
}

void Gluing::Average() {
  for (std::size_t b = 0; b < map_.row.size(); ++b) {
    const std::int32_t first = map_.slot_begin[b], last = map_.slot_begin[b + 1];
    for (int d = 0; d < dofs_; ++d) {
      double sum = 0.0;
      for (std::int32_t slot = first; slot < last; ++slot) sum += slots_[dofs_ * slot + d];
      const double mean = sum / (last - first);
      for (std::int32_t slot = first; slot < last; ++slot) slots_[dofs_ * slot + d] = mean;
    }
  }
}

void Gluing::Apply(std::vector<SubdomainState>* states, InterfaceState* interface, std::vector<JumpPart>* jumps) {
  jumps->assign(problems_.size(), {});
  if (map_.copies.empty()) return;
  FillSlots(*states);
  Average();
  const int inertias = dofs_ - 1;
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    const auto& copy = map_.copies[k];
    double* v = &(*states)[copy.problem].velocity[dofs_ * copy.body];
    const double* inverse = &problems_[copy.problem].inverse_mass[inertias * copy.body];
    const double* mean = &slots_[dofs_ * copy.slot];
    double* f = &interface->impulse[dofs_ * k];
    JumpPart& jump = (*jumps)[copy.problem];
    for (int d = 0; d < dofs_; ++d) {
      const double dv = v[d] - mean[d];
      const double inverse_mass = inverse[d == 2];
      jump.sum_squares += dv * dv * (inverse[0] / inverse_mass);  // I / m = (1/m) / (1/I) for the spin, 1 for translations
      f[d] += dv / inverse_mass;
      v[d] = mean[d];
    }
    jump.copies += 1.0;
  }
}

void Gluing::SubtractImpulse(const InterfaceState& interface, std::vector<SubdomainState>* states) const {
  const int inertias = dofs_ - 1;
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    const auto& copy = map_.copies[k];
    double* v = &(*states)[copy.problem].velocity[dofs_ * copy.body];
    const double* inverse = &problems_[copy.problem].inverse_mass[inertias * copy.body];
    for (int d = 0; d < dofs_; ++d) v[d] -= inverse[d == 2] * interface.impulse[dofs_ * k + d];
  }
}

}  // namespace nscdd
