// SPDX-License-Identifier: Apache-2.0
#include "stepping/warm_start.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "interface/gluing.h"
#include "problem/state.h"

namespace nscdd {
namespace {

/// Impulses of the rows of the table whose keys are in the cache. Table and cache ascend by key: they are merged.
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

/// F per copy of the map: cached ones by (body, subdomain), dropped where the subdomain has no copy any more, zero where it has
/// none yet, re-centred to zero sum per body.
std::vector<double> WarmInterfaceImpulses(const PartitionedProblem& problem, const ImpulseCache& cache, const Sharing& sharing,
                                          double scale) {
  const InterfaceMap& map = problem.interface;
  const int dofs = Dofs(problem.model);
  std::vector<double> impulse(dofs * map.copies.size(), 0.0);
  if (cache.interfaces.empty()) return impulse;
  std::size_t copy = 0;
  for (std::size_t b = 0; b < map.row.size(); ++b) {
    const std::int64_t id = (*problem.body_id)[map.row[b]];
    const auto subdomains = sharing.Of(map.row[b]);
    // What subdomains without a copy leave behind is taken back evenly: the mean over the copies that are there now.
    double mean[3] = {0.0, 0.0, 0.0};
    std::vector<const CachedInterfaceImpulse*> kept(subdomains.size(), nullptr);
    auto entry = std::ranges::lower_bound(cache.interfaces, id, {}, &CachedInterfaceImpulse::body);
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

}  // namespace

PartitionedState WarmState(const PartitionedProblem& problem, const ImpulseCache& cache, const Sharing& sharing, double scale,
                           Communicator* communicator) {
  PartitionedState state = InitialState(problem, WarmImpulses(cache, *problem.contacts, *problem.body_id, scale));
  if (problem.interface.copies.empty()) return state;
  state.interface.impulse = WarmInterfaceImpulses(problem, cache, sharing, scale);
  Gluing(problem.subdomains, problem.interface, communicator).SubtractImpulse(state.interface, &state.subdomains);
  return state;
}

}  // namespace nscdd
