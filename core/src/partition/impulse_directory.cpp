// SPDX-License-Identifier: Apache-2.0
#include "partition/impulse_directory.h"

#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "parallel/bytes.h"

namespace nscdd {
namespace {

/// Ids that a rank owns, and impulses on their way.
struct Parcel {
  std::vector<std::int64_t> owned;
  ImpulseCache cache;
};
using ParcelByRank = std::map<int, Parcel>;

/// Delivers the parcels; one's own stays here. Returns what came, by sender.
ParcelByRank DeliverParcels(ParcelByRank parcels, Communicator* communicator) {
  ParcelByRank received;
  std::vector<Message> outgoing;
  for (auto& [rank, parcel] : parcels) {
    if (rank == communicator->rank()) {
      received[rank] = std::move(parcel);
      continue;
    }
    ByteWriter out(&outgoing.emplace_back(Message{rank, {}}).bytes);
    out.PutSpan(std::span<const std::int64_t>(parcel.owned));
    PutImpulses(parcel.cache, &out);
  }
  for (const Message& message : communicator->Deliver(std::move(outgoing))) {
    ByteReader in(message.bytes);
    Parcel& parcel = received[message.rank];
    parcel.owned = in.GetVector<std::int64_t>();
    GetImpulses(&in, &parcel.cache);
  }
  return received;
}

/// Puts each entry into the parcel to the rank that `rank_of` its body names; -1: nowhere.
template <class RankOf>
void Address(const ImpulseCache& cache, RankOf rank_of, ParcelByRank* parcels) {
  for (const CachedImpulse& entry : cache.contacts) {
    if (const int rank = rank_of(entry.carrier); rank >= 0) (*parcels)[rank].cache.contacts.push_back(entry);
  }
  for (const CachedInterfaceImpulse& entry : cache.interfaces) {
    if (const int rank = rank_of(entry.body); rank >= 0) (*parcels)[rank].cache.interfaces.push_back(entry);
  }
}

}  // namespace

void DeliverToOwners(std::span<const std::int64_t> owned, Communicator* communicator, ImpulseCache* cache) {
  const int ranks = communicator->size();
  if (ranks == 1) return;
  const auto directory = [ranks](std::int64_t id) {
    return static_cast<int>(static_cast<std::uint64_t>(id) % static_cast<std::uint64_t>(ranks));
  };
  // Owners and entries meet at the directories ...
  ParcelByRank to_directories;
  for (const std::int64_t id : owned) to_directories[directory(id)].owned.push_back(id);
  Address(*cache, directory, &to_directories);
  const ParcelByRank at_directory = DeliverParcels(std::move(to_directories), communicator);
  std::unordered_map<std::int64_t, int> owner;
  for (const auto& [rank, parcel] : at_directory) {
    for (const std::int64_t id : parcel.owned) owner[id] = rank;
  }
  // ... from where each entry goes on to the owner of its body.
  const auto owner_of = [&](std::int64_t id) {
    const auto at = owner.find(id);
    return at == owner.end() ? -1 : at->second;
  };
  ParcelByRank to_owners;
  for (const auto& [rank, parcel] : at_directory) Address(parcel.cache, owner_of, &to_owners);
  cache->Clear();
  for (const auto& [rank, parcel] : DeliverParcels(std::move(to_owners), communicator)) cache->Append(parcel.cache);
  cache->Sort();
}

}  // namespace nscdd
