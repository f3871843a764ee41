// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/platform_adapter.h"
#include "partition/impulse_cache.h"
#include "partition/population.h"

namespace nscdd {

/// A body that comes into this rank's host.
struct Arrival {
  std::int64_t id;
  std::vector<std::byte> shapes;    ///< what BodyTransport::Pack() made of it
  std::vector<std::byte> replaced;  ///< what was here under this id, packed
  bool is_removed = false, is_inserted = false;
};

// What one rank tells another about bodies: a message holds records, one behind the other, each of them a body or a removal.

/// Row `row` of the population, its holders and cached impulses, and what `transport` packs of it (null: the host has it).
/// `by_carrier` is a cache whose contacts are sorted by carrier.
void PutBody(const Population& population, std::size_t row, const ImpulseCache& by_carrier, BodyTransport* transport,
             std::vector<std::byte>* bytes);
void PutRemoval(std::int64_t id, std::vector<std::byte>* bytes);

/// Appends the bodies of a message to the population (unsorted) and their impulses to the cache.
void TakeRecords(std::span<const std::byte> message, Population* population, ImpulseCache* cache,
                 std::vector<Arrival>* arrivals, std::vector<std::int64_t>* removals);

}  // namespace nscdd
