// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interface/interface_map.h"
#include "nscdd/contact_table.h"
#include "parallel/bytes.h"

namespace nscdd {

/// Impulse of a contact at the end of a step. It travels with its carrier, a free body of the contact (A if that is free),
/// which is held by every rank that can meet the contact in the next step.
struct CachedImpulse {
  std::int64_t carrier;
  ContactKey key;
  Vec2 impulse;  ///< [N s]
};

/// Interface impulse F_E of a body's copy at the end of a step; travels with the body.
struct CachedInterfaceImpulse {
  std::int64_t body;
  std::int32_t subdomain;
  double force[3];  ///< [N s, N s, N m s]
};

/// First iterates for the next step. Entries are sorted for the searches below by Sort().
struct ImpulseCache {
  std::vector<CachedImpulse> contacts;             ///< by key
  std::vector<CachedInterfaceImpulse> interfaces;  ///< by (body, subdomain)
  double dt = 0.0;                                 ///< [s] of the step that left them

  /// Also drops entries that are there twice (a step was repeated after a failure).
  void Sort();
  void Append(const ImpulseCache& other);
};

/// Impulses of the rows of `table` whose keys are in the cache, zero for the others, times `scale` (ratio of the time steps).
/// Searches by merging when the table is sorted by key, as DetectContacts() promises.
std::vector<Vec2> WarmImpulses(const ImpulseCache& cache, const ContactTable& table, std::span<const std::int64_t> body_id,
                               double scale);

/// F per copy of the map: cached ones by (body, subdomain), dropped where the subdomain has no copy any more, zero where it has
/// none yet, re-centred to zero sum per body.
std::vector<double> WarmInterfaceImpulses(const ImpulseCache& cache, const InterfaceMap& map, const Sharing& sharing,
                                          const std::vector<SubdomainProblem>& problems, std::span<const std::int64_t> body_id,
                                          double scale);

ContactKey KeyOf(const ContactTable& table, std::size_t contact, std::span<const std::int64_t> body_id);

}  // namespace nscdd
