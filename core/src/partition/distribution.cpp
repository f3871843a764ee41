// SPDX-License-Identifier: Apache-2.0
#include "partition/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nscdd/error.h"
#include "parallel/agreement.h"

namespace nscdd {
namespace {

enum class Record : std::uint8_t { kBody, kRemoval };

[[noreturn]] void RefuseTwice(std::int64_t id) {
  throw Error(
      fmt::format("body {} is in the hosts of several ranks; ids are unique and every new body is in exactly one host, the "
                  "solver makes the ghosts",
                  id));
}

void CheckSize(const std::vector<std::byte>& parcel, int rank) {
  if (parcel.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max())) return;
  throw Error(fmt::format(
      "{} bytes of bodies would go to rank {} at once, a message holds 2^31 - 1; spread the bodies over the hosts of "
      "several ranks from the start",
      parcel.size(), rank));
}

bool Contains(const std::vector<int>& ranks, int rank) { return std::binary_search(ranks.begin(), ranks.end(), rank); }

}  // namespace

// The site of two disks is the mid-point of their centres: (rho_i + rho_j + alert) / 2 from a disk's centre at most; that of a
// disk and another wall is on the wall, rho_i + alert from it. A disk's centre is within bounding_radius of the centre of mass.
double Reach::Of(double radius, double bounding_radius) const {
  const double half = 0.5 * (largest_radius + alert);
  const double exact =
      bounding_radius == radius ? std::max(radius + alert, 0.5 * radius + half) : bounding_radius + std::max(alert, half);
  return exact * (1.0 + 1e-6);  // rounding of sites and gaps
}

void Distribution::TakeOver(BodyTable read) {
  const int me = communicator_->rank();
  Population next;
  next.bodies = std::move(read);
  next.owner.assign(next.bodies.size(), me);
  next.holders.resize(next.bodies.size());
  SortById(&next);
  const auto twice = std::adjacent_find(next.bodies.id.begin(), next.bodies.id.end());
  if (twice != next.bodies.id.end()) {
    throw Error(
        fmt::format("adapter '{}', ReadBodies: body {} is there twice; ids are unique", adapter_->Describe().name, *twice));
  }
  removed_.clear();
  removed_from_.clear();
  if (!unwanted_.empty()) SkipUnwanted(&next);
  if (communicator_->size() > 1) Recognise(&next);
  population_ = std::move(next);
}

void Distribution::Forget() {
  population_ = known_ = {};
  settled_ = false;
  unwanted_.clear();
}

/// Bodies that a failed step left in the host are not there for anybody.
void Distribution::SkipUnwanted(Population* next) {
  std::erase_if(unwanted_, [&](std::int64_t id) { return next->RowOf(id) < 0; });
  std::vector<char> keep(next->size(), 1);
  for (const std::int64_t id : unwanted_) keep[next->RowOf(id)] = 0;
  Filter(keep, next);
}

void Distribution::Recognise(Population* next) {
  if (settled_) known_ = std::move(population_);
  settled_ = false;
  newcomers_ = next->size();
  std::vector<char> keep(next->size(), 1);
  std::size_t now = 0;
  for (std::size_t row = 0; row < known_.size(); ++row) {
    const std::int64_t id = known_.bodies.id[row];
    while (now < next->size() && next->bodies.id[now] < id) ++now;
    const bool is_here = now < next->size() && next->bodies.id[now] == id;
    newcomers_ -= is_here;
    if (known_.owner[row] != communicator_->rank()) {
      if (!is_here) {
        throw Error(
            fmt::format("body {} was removed from the host of rank {}, which holds a ghost of it; remove it on rank {}, "
                        "its owner",
                        id, communicator_->rank(), known_.owner[row]));
      }
      keep[now] = 0;
    } else if (is_here) {
      next->holders[now] = known_.holders[row];
    } else {
      removed_.push_back(id);
      removed_from_.push_back(known_.holders[row]);
    }
  }
  Filter(keep, next);
}

// Each id is told to the rank id % ranks, which meets all those that are equal.
void Distribution::CheckIdsAreUnique() const {
  const int ranks = communicator_->size();
  if (ranks == 1) return;
  std::vector<std::vector<std::int64_t>> told(ranks);
  for (const std::int64_t id : population_.bodies.id) told[id % ranks].push_back(id);
  std::vector<std::int64_t> met = std::move(told[communicator_->rank()]);
  std::vector<Message> outgoing;
  for (int rank = 0; rank < ranks; ++rank) {
    if (rank == communicator_->rank() || told[rank].empty()) continue;
    ByteWriter(&outgoing.emplace_back(Message{rank, {}}).bytes).PutSpan(std::span<const std::int64_t>(told[rank]));
  }
  for (const Message& message : communicator_->Deliver(std::move(outgoing))) {
    const auto more = ByteReader(message.bytes).GetVector<std::int64_t>();
    met.insert(met.end(), more.begin(), more.end());
  }
  RunTogether(communicator_, [&] {
    std::sort(met.begin(), met.end());
    const auto twice = std::adjacent_find(met.begin(), met.end());
    if (twice != met.end()) RefuseTwice(*twice);
  });
}

void Distribution::PackBody(std::size_t row, int home, const std::vector<int>& holders, bool with_shapes,
                            const ImpulseCache& by_carrier, std::vector<std::byte>* bytes) {
  ByteWriter out(bytes);
  const BodyTable& t = population_.bodies;
  const std::int64_t id = t.id[row];
  out.Put(Record::kBody);
  ForEachColumn(t, [&](const auto& column) { out.Put(column[row]); });
  out.Put(home);
  out.PutSpan(std::span<const int>(holders));
  const auto contacts = std::equal_range(by_carrier.contacts.begin(), by_carrier.contacts.end(), CachedImpulse{id, {}, {}},
                                         [](const auto& a, const auto& b) { return a.carrier < b.carrier; });
  out.PutSpan(std::span<const CachedImpulse>(contacts.first, contacts.second));
  const auto copies =
      std::equal_range(by_carrier.interfaces.begin(), by_carrier.interfaces.end(), CachedInterfaceImpulse{id, 0, {}},
                       [](const auto& a, const auto& b) { return a.body < b.body; });
  out.PutSpan(std::span<const CachedInterfaceImpulse>(copies.first, copies.second));
  out.Put(with_shapes);
  if (!with_shapes) return;
  std::vector<std::byte> shapes;
  adapter_->transport()->Pack(id, &shapes);
  out.PutSpan(std::span<const std::byte>(shapes));
}

void Distribution::PackAll(const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks, const Reach& reach,
                           const ImpulseCache& cache, Parcels* parcels) {
  const int me = communicator_->rank();
  ImpulseCache by_carrier = cache;
  std::stable_sort(by_carrier.contacts.begin(), by_carrier.contacts.end(),
                   [](const auto& a, const auto& b) { return a.carrier < b.carrier; });
  for (std::size_t row = 0; row < population_.size(); ++row) {
    const Vec2 centre = Centre(detection[row]);
    const int home = blocks.RankOf(grid.CellOf(centre));
    std::vector<int> needed{home};
    grid.ForEachCellNear(centre, reach.Of(population_.bodies.radius[row], population_.bodies.bounding_radius[row]),
                         [&](int cell) {
                           const int rank = blocks.RankOf(cell);
                           if (needed.back() != rank) needed.push_back(rank);
                         });
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());

    std::vector<int>& before = population_.holders[row];
    for (const int rank : needed) {
      const bool has_it = before.empty() ? rank == me : Contains(before, rank);
      // A new owner's host takes over all that the old one knows (loads, the user's edits), so its ghost is replaced.
      if (rank != me) PackBody(row, home, needed, !has_it || rank == home, by_carrier, &(*parcels)[rank]);
    }
    for (const int rank : before) {
      if (rank == me || Contains(needed, rank)) continue;
      ByteWriter out(&(*parcels)[rank]);
      out.Put(Record::kRemoval);
      out.Put(population_.bodies.id[row]);
    }
    if (!Contains(needed, me)) leaving_.push_back(population_.bodies.id[row]);
    migrated_ += home != me;
    population_.owner[row] = home;
    if (needed.size() == 1) needed.clear();
    before = std::move(needed);
  }
  for (std::size_t i = 0; i < removed_.size(); ++i) {
    for (const int rank : removed_from_[i]) {
      if (rank == me) continue;
      ByteWriter out(&(*parcels)[rank]);
      out.Put(Record::kRemoval);
      out.Put(removed_[i]);
    }
  }
}

bool Distribution::HasGhost(std::int64_t id) const {
  const std::ptrdiff_t row = known_.RowOf(id);
  return row >= 0 && known_.owner[row] != communicator_->rank();
}

void Distribution::Unpack(const Message& message, ImpulseCache* cache) {
  ByteReader in(message.bytes);
  while (!in.empty()) {
    if (in.Get<Record>() == Record::kRemoval) {
      const auto id = in.Get<std::int64_t>();
      if (HasGhost(id)) leaving_.push_back(id);
      continue;
    }
    BodyTable& t = population_.bodies;
    ForEachColumn(t, [&](auto& column) {
      using Value = typename std::decay_t<decltype(column)>::value_type;
      column.push_back(in.Get<Value>());
    });
    population_.owner.push_back(in.Get<int>());
    population_.holders.push_back(in.GetVector<int>());
    if (population_.holders.back().size() == 1) population_.holders.back().clear();
    const auto contacts = in.GetVector<CachedImpulse>();
    const auto interfaces = in.GetVector<CachedInterfaceImpulse>();
    cache->contacts.insert(cache->contacts.end(), contacts.begin(), contacts.end());
    cache->interfaces.insert(cache->interfaces.end(), interfaces.begin(), interfaces.end());
    if (in.Get<bool>()) arrivals_.push_back({.id = t.id.back(), .shapes = in.GetVector<std::byte>(), .replaced = {}});
  }
}

/// Bodies come in before others go, and what they replace is kept: a body is always in some host, whatever fails.
void Distribution::InsertArrivals() {
  BodyTransport* transport = adapter_->transport();
  for (Arrival& arrival : arrivals_) {
    if (HasGhost(arrival.id) || std::count(unwanted_.begin(), unwanted_.end(), arrival.id) > 0) {
      transport->Pack(arrival.id, &arrival.replaced);
      transport->Remove(arrival.id);
      arrival.is_removed = true;
    }
    transport->Insert(arrival.id, arrival.shapes);
    arrival.is_inserted = true;
  }
}

/// The hosts become what they were before InsertArrivals(), as far as they can: the failure that led here is told, a second one
/// is not.
void Distribution::UndoArrivals() {
  BodyTransport* transport = adapter_->transport();
  for (Arrival& arrival : arrivals_) {
    try {
      if (arrival.is_inserted) transport->Remove(arrival.id);
      if (arrival.is_removed) transport->Insert(arrival.id, arrival.replaced);
    } catch (...) {
    }
  }
}

void Distribution::RemoveUnwanted() {
  for (; !unwanted_.empty(); unwanted_.pop_back()) adapter_->transport()->Remove(unwanted_.back());
}

void Distribution::SortRows() {
  SortById(&population_);
  const auto& id = population_.bodies.id;
  const auto twice = std::adjacent_find(id.begin(), id.end());
  if (twice != id.end()) RefuseTwice(*twice);
}

void Distribution::Move(const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks, const Reach& reach,
                        ImpulseCache* cache) {
  migrated_ = 0;
  leaving_.clear();
  arrivals_.clear();
  if (communicator_->size() == 1) return;
  Parcels parcels;
  RunTogether(communicator_, [&] {
    PackAll(detection, grid, blocks, reach, *cache, &parcels);
    for (const auto& [rank, bytes] : parcels) CheckSize(bytes, rank);
  });
  std::vector<Message> outgoing;
  for (auto& [rank, bytes] : parcels) outgoing.push_back({rank, std::move(bytes)});
  const std::vector<Message> incoming = communicator_->Deliver(std::move(outgoing));
  try {
    RunTogether(communicator_, [&] {
      std::vector<char> keep(population_.size(), 1);
      for (const std::int64_t id : leaving_) keep[population_.RowOf(id)] = 0;
      Filter(keep, &population_);
      for (const Message& message : incoming) Unpack(message, cache);
      SortRows();
      cache->Sort();
      InsertArrivals();
    });
  } catch (const Error&) {
    UndoArrivals();
    throw;
  }
  settled_ = true;
  arrivals_.clear();
  unwanted_.insert(unwanted_.end(), leaving_.begin(), leaving_.end());
  std::erase_if(unwanted_, [&](std::int64_t id) { return population_.RowOf(id) >= 0; });
  RunTogether(communicator_, [&] { RemoveUnwanted(); });
}

Sharing Distribution::Share(std::vector<std::pair<std::int32_t, std::int32_t>> pairs) const {
  Sharing mine = MakeSharing(population_.size(), pairs);
  if (communicator_->size() == 1) return mine;
  const int me = communicator_->rank();
  Parcels parcels;
  for (std::size_t row = 0; row < population_.size(); ++row) {
    for (const int rank : population_.holders[row]) {
      if (rank == me) continue;
      for (const std::int32_t subdomain : mine.Of(row)) {
        ByteWriter out(&parcels[rank]);
        out.Put(population_.bodies.id[row]);
        out.Put(subdomain);
      }
    }
  }
  std::vector<Message> outgoing;
  for (auto& [rank, bytes] : parcels) outgoing.push_back({rank, std::move(bytes)});
  for (const Message& message : communicator_->Deliver(std::move(outgoing))) {
    ByteReader in(message.bytes);
    while (!in.empty()) {
      const auto id = in.Get<std::int64_t>();
      const auto subdomain = in.Get<std::int32_t>();
      pairs.emplace_back(static_cast<std::int32_t>(population_.RowOf(id)), subdomain);
    }
  }
  return MakeSharing(population_.size(), pairs);
}

}  // namespace nscdd
