// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/contact_table.h"
#include "nscdd/vector.h"
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

  /// Also drops entries that are there twice (a step was repeated after a failure).
  void Sort();
  void Append(const ImpulseCache& other);
  /// Keeps the memory.
  void Clear() {
    contacts.clear();
    interfaces.clear();
  }
};

/// The entries field by field, as they cross between ranks and runs.
void PutImpulses(const ImpulseCache& cache, ByteWriter* out);
/// Adds what PutImpulses() wrote. Throws Error when the bytes end too soon.
void GetImpulses(ByteReader* in, ImpulseCache* cache);

}  // namespace nscdd
