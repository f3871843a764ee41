// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "nscdd/communicator.h"
#include "nscdd/platform_adapter.h"
#include "partition/grid.h"
#include "partition/halo_plan.h"
#include "partition/host_exchange.h"
#include "partition/impulse_cache.h"
#include "partition/population.h"

namespace nscdd {

/// Keeps each body on the rank of its home cell and ghosts where they are needed. Bodies move between neighbours only, in one
/// round of messages a step; with them go their cached impulses.
class BodyMigration {
 public:
  BodyMigration(PlatformAdapter* adapter, Communicator* communicator)
      : adapter_(adapter), communicator_(communicator), host_(adapter) {}

  /// The host's bodies: rows of owned and of new ones are taken over, ghosts' rows wait for their owners' messages. Local, and
  /// may be repeated until Move() has succeeded: a step that failed on another rank leaves no trace.
  void TakeOver(BodyTable read);

  /// The next TakeOver() meets every body for the first time; each is then in one host, without ghosts.
  void Forget();

  /// Bodies taken over that were not here after the last Move(); 0 on one rank.
  std::size_t newcomers() const { return newcomers_; }

  /// Moves bodies so that every rank holds what its subdomains need at the configuration `detection` (of the owned rows, in
  /// order). `cache` holds the owned bodies' impulses before, and those of all held bodies after. Collective; when a host
  /// fails, the same Error is thrown on all ranks, every body is in some host, and TakeOver() and Move() may be tried again.
  void Move(const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks, const Reach& reach,
            ImpulseCache* cache);

  const Population& population() const { return population_; }
  std::int64_t migrated() const { return migrated_; }  ///< owned bodies that left this rank in the last Move()

 private:
  using Parcels = std::map<int, std::vector<std::byte>>;
  void SkipUnwanted(Population* next);
  void Recognise(Population* next);
  Parcels Pack(const HaloPlan& plan, const ImpulseCache& cache) const;
  void Unpack(const std::vector<Message>& incoming, ImpulseCache* cache, std::vector<Arrival>* arrivals,
              std::vector<std::int64_t>* leaving);
  bool HasGhost(std::int64_t id) const;

  PlatformAdapter* adapter_;
  Communicator* communicator_;
  HostExchange host_;
  Population population_;
  Population known_;      // after the last Move(); what TakeOver() compares with
  bool settled_ = false;  // population_ is that of a finished Move()
  std::size_t newcomers_ = 0;
  std::vector<HaloPlan::Removal> removed_;  // ghosts of owned bodies that the host's user removed
  std::int64_t migrated_ = 0;
};

}  // namespace nscdd
