// SPDX-License-Identifier: Apache-2.0
#include "partition/host_exchange.h"

#include <algorithm>

namespace nscdd {

void HostExchange::Insert(Arrival* arrival, bool replaces) {
  BodyTransport* transport = adapter_->transport();
  if (replaces) {
    transport->Pack(arrival->id, &arrival->replaced);
    transport->Remove(arrival->id);
    arrival->is_removed = true;
  }
  transport->Insert(arrival->id, arrival->shapes);
  arrival->is_inserted = true;
}

void HostExchange::Undo(std::vector<Arrival>* arrivals) {
  BodyTransport* transport = adapter_->transport();
  for (Arrival& arrival : *arrivals) {
    try {
      if (arrival.is_inserted) transport->Remove(arrival.id);
      if (arrival.is_removed) transport->Insert(arrival.id, arrival.replaced);
    } catch (...) {
    }
  }
}

void HostExchange::RemoveUnwanted() {
  for (; !unwanted_.empty(); unwanted_.pop_back()) adapter_->transport()->Remove(unwanted_.back());
}

bool HostExchange::IsUnwanted(std::int64_t id) const {
  return std::find(unwanted_.begin(), unwanted_.end(), id) != unwanted_.end();
}

}  // namespace nscdd
