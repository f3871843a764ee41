// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/platform_adapter.h"
#include "partition/body_parcel.h"

namespace nscdd {

/// Puts bodies into this rank's host and takes others out, so that a body is always in some host, whatever fails: arrivals come
/// in before others go, and what they replace is kept until all ranks have theirs.
class HostExchange {
 public:
  explicit HostExchange(PlatformAdapter* adapter) : adapter_(adapter) {}

  /// `ghosts(id)`: the host has a ghost under this id, which the arrival replaces. Throws what the host throws; Undo() then.
  template <class HasGhost>
  void Insert(std::vector<Arrival>* arrivals, HasGhost has_ghost) {
    for (Arrival& arrival : *arrivals) Insert(&arrival, has_ghost(arrival.id) || IsUnwanted(arrival.id));
  }
  /// The host becomes what it was before Insert(), as far as it can: the failure that led here is told, a second one is not.
  void Undo(std::vector<Arrival>* arrivals);

  /// Bodies of the host that are of no use here any more: to be removed, and not there for anybody until they are.
  std::vector<std::int64_t>& unwanted() { return unwanted_; }
  void RemoveUnwanted();

 private:
  void Insert(Arrival* arrival, bool replaces);
  bool IsUnwanted(std::int64_t id) const;

  PlatformAdapter* adapter_;
  std::vector<std::int64_t> unwanted_;
};

}  // namespace nscdd
