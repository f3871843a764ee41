// SPDX-License-Identifier: Apache-2.0
#include "interface/copy_average.h"

namespace nscdd {

CopyAverage::CopyAverage(const InterfaceMap& map, int dofs, Communicator* communicator)
    : map_(map), dofs_(dofs), communicator_(communicator), slots_(dofs * map.slot_count()) {
  for (const auto& neighbour : map.neighbours) {
    send_.emplace_back(dofs * neighbour.send.size());
    receive_.emplace_back(dofs * neighbour.receive.size());
  }
}

void CopyAverage::FillSlots(const std::vector<double>& values) {
  for (std::size_t k = 0; k < map_.copies.size(); ++k) {
    for (int d = 0; d < dofs_; ++d) slots_[dofs_ * map_.copies[k].slot + d] = values[dofs_ * k + d];
  }
  if (map_.neighbours.empty()) return;
  // Each pair of ranks exchanges the slots that the other one lacks.
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

void CopyAverage::Average(std::vector<double>* values) {
  FillSlots(*values);
  std::size_t copy = 0;
  for (std::size_t b = 0; b < map_.row.size(); ++b) {
    const std::int32_t first = map_.slot_begin[b], last = map_.slot_begin[b + 1];
    const std::size_t begin = copy;
    for (int d = 0; d < dofs_; ++d) {
      double sum = 0.0;
      for (std::int32_t slot = first; slot < last; ++slot) sum += slots_[dofs_ * slot + d];
      const double mean = sum / (last - first);
      for (copy = begin; copy < map_.copies.size() && map_.copies[copy].slot < last; ++copy) (*values)[dofs_ * copy + d] = mean;
    }
  }
}

void CopyAverage::Project(std::vector<double>* values) {
  scratch_ = *values;
  Average(&scratch_);
  for (std::size_t i = 0; i < values->size(); ++i) (*values)[i] -= scratch_[i];
}

}  // namespace nscdd
