// SPDX-License-Identifier: Apache-2.0
#include "partition/impulse_cache.h"

#include <algorithm>
#include <utility>

namespace nscdd {
namespace {

void PutKey(const ContactKey& key, ByteWriter* out) {
  out->Put(key.body_a);
  out->Put(key.body_b);
  out->Put(key.shape_a);
  out->Put(key.shape_b);
  out->Put(key.image);
}

ContactKey GetKey(ByteReader* in) {
  ContactKey key;
  key.body_a = in->Get<std::int64_t>();
  key.body_b = in->Get<std::int64_t>();
  key.shape_a = in->Get<std::int32_t>();
  key.shape_b = in->Get<std::int32_t>();
  key.image = in->Get<std::int32_t>();
  return key;
}

bool ByKey(const CachedImpulse& a, const CachedImpulse& b) { return a.key < b.key; }
bool ByBody(const CachedInterfaceImpulse& a, const CachedInterfaceImpulse& b) {
  return std::pair(a.body, a.subdomain) < std::pair(b.body, b.subdomain);
}

}  // namespace

void ImpulseCache::Sort() {
  // Mostly sorted already: looking is cheaper than sorting.
  const auto sort = [](auto* entries, auto before) {
    if (!std::is_sorted(entries->begin(), entries->end(), before)) std::sort(entries->begin(), entries->end(), before);
    // Neighbours in the order are equal when neither is before the other.
    const auto equal = [&](const auto& a, const auto& b) { return !before(a, b); };
    entries->erase(std::unique(entries->begin(), entries->end(), equal), entries->end());
  };
  sort(&contacts, ByKey);
  sort(&interfaces, ByBody);
}

void ImpulseCache::Append(const ImpulseCache& other) {
  contacts.insert(contacts.end(), other.contacts.begin(), other.contacts.end());
  interfaces.insert(interfaces.end(), other.interfaces.begin(), other.interfaces.end());
}

void PutImpulses(const ImpulseCache& cache, ByteWriter* out) {
  out->Put(static_cast<std::uint64_t>(cache.contacts.size()));
  for (const CachedImpulse& entry : cache.contacts) {
    out->Put(entry.carrier);
    PutKey(entry.key, out);
    out->Put(entry.impulse);
  }
  out->Put(static_cast<std::uint64_t>(cache.interfaces.size()));
  for (const CachedInterfaceImpulse& entry : cache.interfaces) {
    out->Put(entry.body);
    out->Put(entry.subdomain);
    for (const double f : entry.force) out->Put(f);
  }
}

// Counts that the bytes cannot hold end the loops by the reader's Error, before memory does.
void GetImpulses(ByteReader* in, ImpulseCache* cache) {
  for (auto left = in->Get<std::uint64_t>(); left > 0; --left) {
    CachedImpulse entry{};
    entry.carrier = in->Get<std::int64_t>();
    entry.key = GetKey(in);
    entry.impulse = in->Get<Vec2>();
    cache->contacts.push_back(entry);
  }
  for (auto left = in->Get<std::uint64_t>(); left > 0; --left) {
    CachedInterfaceImpulse entry{};
    entry.body = in->Get<std::int64_t>();
    entry.subdomain = in->Get<std::int32_t>();
    for (double& f : entry.force) f = in->Get<double>();
    cache->interfaces.push_back(entry);
  }
}

}  // namespace nscdd
