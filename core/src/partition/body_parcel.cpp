// SPDX-License-Identifier: Apache-2.0
#include "partition/body_parcel.h"

#include <algorithm>
#include <type_traits>

#include "parallel/bytes.h"

namespace nscdd {
namespace {

enum class Record : std::uint8_t { kBody, kRemoval };

void TakeBody(ByteReader* in, Population* population, ImpulseCache* cache, std::vector<Arrival>* arrivals) {
  // The order of PutBody().
  BodyTable& t = population->bodies;
  ForEachColumn(t, [&](auto& column) {
    using Value = typename std::decay_t<decltype(column)>::value_type;
    column.push_back(in->Get<Value>());
  });
  population->owner.push_back(in->Get<int>());
  population->holders.push_back(in->GetVector<int>());
  if (population->holders.back().size() == 1) population->holders.back().clear();
  const auto contacts = in->GetVector<CachedImpulse>();
  const auto interfaces = in->GetVector<CachedInterfaceImpulse>();
  cache->contacts.insert(cache->contacts.end(), contacts.begin(), contacts.end());
  cache->interfaces.insert(cache->interfaces.end(), interfaces.begin(), interfaces.end());
  const bool with_shapes = in->Get<bool>();
  if (with_shapes) arrivals->push_back({.id = t.id.back(), .shapes = in->GetVector<std::byte>(), .replaced = {}});
}

}  // namespace

void PutBody(const Population& population, std::size_t row, const ImpulseCache& by_carrier, BodyTransport* transport,
             std::vector<std::byte>* bytes) {
  ByteWriter out(bytes);
  const std::int64_t id = population.bodies.id[row];
  out.Put(Record::kBody);
  ForEachColumn(population.bodies, [&](const auto& column) { out.Put(column[row]); });
  out.Put(population.owner[row]);
  out.PutSpan(std::span<const int>(population.holders[row]));
  const auto contacts = std::ranges::equal_range(by_carrier.contacts, id, {}, &CachedImpulse::carrier);
  out.PutSpan(std::span<const CachedImpulse>(contacts));
  const auto copies = std::ranges::equal_range(by_carrier.interfaces, id, {}, &CachedInterfaceImpulse::body);
  out.PutSpan(std::span<const CachedInterfaceImpulse>(copies));
  out.Put(transport != nullptr);
  if (transport == nullptr) return;
  std::vector<std::byte> shapes;
  transport->Pack(id, &shapes);
  out.PutSpan(std::span<const std::byte>(shapes));
}

void PutRemoval(std::int64_t id, std::vector<std::byte>* bytes) {
  ByteWriter out(bytes);
  out.Put(Record::kRemoval);
  out.Put(id);
}

void TakeRecords(std::span<const std::byte> message, Population* population, ImpulseCache* cache,
                 std::vector<Arrival>* arrivals, std::vector<std::int64_t>* removals) {
  for (ByteReader in(message); !in.empty();) {
    if (in.Get<Record>() == Record::kRemoval) {
      removals->push_back(in.Get<std::int64_t>());
    } else {
      TakeBody(&in, population, cache, arrivals);
    }
  }
}

}  // namespace nscdd
