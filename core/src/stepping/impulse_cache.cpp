// SPDX-License-Identifier: Apache-2.0
#include "stepping/impulse_cache.h"

#include <algorithm>
#include <utility>

namespace nscdd {
namespace {

bool ByKey(const CachedImpulse& a, const CachedImpulse& b) { return a.key < b.key; }
bool ByBody(const CachedInterfaceImpulse& a, const CachedInterfaceImpulse& b) {
  return std::pair(a.body, a.subdomain) < std::pair(b.body, b.subdomain);
}

}  // namespace

void ImpulseCache::Sort() {
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

ContactKey KeyOf(const ContactTable& t, std::size_t c, std::span<const std::int64_t> body_id) {
  return {body_id[t.a[c]], body_id[t.b[c]], t.shape_a[c], t.shape_b[c], t.has_images() ? t.image[c] : 0};
}

std::vector<Vec2> WarmImpulses(const ImpulseCache& cache, const ContactTable& table, std::span<const std::int64_t> body_id,
                               double scale) {
  std::vector<Vec2> warm(table.size());
  auto entry = cache.contacts.begin();
  for (std::size_t c = 0; c < table.size() && entry != cache.contacts.end(); ++c) {
    const ContactKey key = KeyOf(table, c, body_id);
    while (entry != cache.contacts.end() && entry->key < key) ++entry;
    if (entry != cache.contacts.end() && entry->key == key) warm[c] = scale * entry->impulse;
  }
  return warm;
}

std::vector<double> WarmInterfaceImpulses(const ImpulseCache& cache, const InterfaceMap& map, const Sharing& sharing,
                                          const std::vector<SubdomainProblem>& problems, std::span<const std::int64_t> body_id,
                                          double scale) {
  const int dofs = problems.empty() ? 0 : Dofs(problems.front().model);
  std::vector<double> impulse(dofs * map.copies.size(), 0.0);
  if (map.copies.empty() || cache.interfaces.empty()) return impulse;
  std::size_t copy = 0;
  for (std::size_t b = 0; b < map.row.size(); ++b) {
    const std::int64_t id = body_id[map.row[b]];
    const auto subdomains = sharing.Of(map.row[b]);
    double mean[3] = {0.0, 0.0, 0.0};
    std::vector<const CachedInterfaceImpulse*> kept(subdomains.size(), nullptr);
    auto entry = std::lower_bound(cache.interfaces.begin(), cache.interfaces.end(), CachedInterfaceImpulse{id, -1, {}}, ByBody);
    for (; entry != cache.interfaces.end() && entry->body == id; ++entry) {
      const auto at = std::lower_bound(subdomains.begin(), subdomains.end(), entry->subdomain);
      if (at == subdomains.end() || *at != entry->subdomain) continue;
      kept[at - subdomains.begin()] = &*entry;
      for (int d = 0; d < dofs; ++d) mean[d] += entry->force[d] / static_cast<double>(subdomains.size());
    }
    for (; copy < map.copies.size() && map.copies[copy].slot < map.slot_begin[b + 1]; ++copy) {
      const CachedInterfaceImpulse* own = kept[map.copies[copy].slot - map.slot_begin[b]];
      for (int d = 0; d < dofs; ++d) impulse[dofs * copy + d] = scale * ((own ? own->force[d] : 0.0) - mean[d]);
    }
  }
  return impulse;
}

}  // namespace nscdd
