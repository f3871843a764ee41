// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "nscdd/communicator.h"
#include "nscdd/platform_adapter.h"
#include "partition/grid.h"
#include "partition/population.h"
#include "partition/sharing.h"
#include "stepping/impulse_cache.h"

namespace nscdd {

/// How far from its centre a body may have contact sites at a detection.
struct Reach {
  double largest_radius = 0.0;  ///< [m] of any disk, on any rank
  double alert = 0.0;           ///< [m]

  double Of(double radius, double bounding_radius) const;
};

/// Keeps each body on the rank of its home cell and ghosts where they are needed. Bodies move between neighbours only, in one
/// round of messages a step; with them go their cached impulses.
class Distribution {
 public:
  Distribution(PlatformAdapter* adapter, Communicator* communicator) : adapter_(adapter), communicator_(communicator) {}

  /// The host's bodies: rows of owned and of new ones are taken over, ghosts' rows wait for their owners' words. Local, and may
  /// be repeated until Move() has succeeded: a step that failed on another rank leaves no trace.
  void TakeOver(BodyTable read);

  /// The next TakeOver() meets every body for the first time; each is then in one host, without ghosts.
  void Forget();

  /// Bodies taken over that were not here after the last Move().
  std::size_t newcomers() const { return newcomers_; }

  /// Throws Error on all ranks when a body is in several hosts. Collective; needed when some rank has newcomers.
  void CheckIdsAreUnique() const;

  /// Moves bodies so that every rank holds what its subdomains need at the configuration `detection` (of the owned rows, in
  /// order). `cache` holds the owned bodies' impulses before, and those of all held bodies after. Collective; when a host
  /// fails, the same Error is thrown on all ranks, every body is in some host, and TakeOver() and Move() may be tried again.
  void Move(const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks, const Reach& reach,
            ImpulseCache* cache);

  /// Completes a list of (row, subdomain) of this rank's contacts to the sharing of all held bodies. Collective.
  Sharing Share(std::vector<std::pair<std::int32_t, std::int32_t>> pairs) const;

  const Population& population() const { return population_; }
  bool Owns(std::size_t row) const { return population_.owner[row] == communicator_->rank(); }
  std::int64_t migrated() const { return migrated_; }  ///< owned bodies that left this rank in the last Move()

 private:
  using Parcels = std::map<int, std::vector<std::byte>>;
  /// A body that comes into this host.
  struct Arrival {
    std::int64_t id;
    std::vector<std::byte> shapes;
    std::vector<std::byte> replaced;  // what was here under this id, packed
    bool is_removed = false, is_inserted = false;
  };
  void SkipUnwanted(Population* next);
  void Recognise(Population* next);
  void PackAll(const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks, const Reach& reach,
               const ImpulseCache& cache, Parcels* parcels);
  void PackBody(std::size_t row, int home, const std::vector<int>& holders, bool with_shapes, const ImpulseCache& by_carrier,
                std::vector<std::byte>* bytes);
  bool HasGhost(std::int64_t id) const;
  void Unpack(const Message& message, ImpulseCache* cache);
  void SortRows();
  void InsertArrivals();
  void UndoArrivals();
  void RemoveUnwanted();

  PlatformAdapter* adapter_;
  Communicator* communicator_;
  Population population_;
  Population known_;      // after the last Move(); what TakeOver() compares with
  bool settled_ = false;  // population_ is that of a finished Move()
  std::size_t newcomers_ = 0;
  std::vector<std::int64_t> removed_;           // owned bodies that the host's user removed
  std::vector<std::vector<int>> removed_from_;  // their other holders
  std::vector<std::int64_t> leaving_;           // bodies that this host need not hold any more
  std::vector<Arrival> arrivals_;
  std::vector<std::int64_t> unwanted_;  // in this host, but of no use here: to be removed
  std::int64_t migrated_ = 0;
};

}  // namespace nscdd
