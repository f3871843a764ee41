// SPDX-License-Identifier: Apache-2.0
#include "partition/body_migration.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "nscdd/agreement.h"
#include "nscdd/error.h"
#include "partition/body_parcel.h"
#include "partition/unique_ids.h"

namespace nscdd {
namespace {

void CheckSize(const std::vector<std::byte>& parcel, int rank) {
  if (parcel.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max())) return;
  throw Error(fmt::format(
      "{} bytes of bodies would go to rank {} at once, a message holds 2^31 - 1; spread the bodies over the hosts of "
      "several ranks from the start",
      parcel.size(), rank));
}

}  // namespace

void BodyMigration::TakeOver(BodyTable read) {
  const int me = communicator_->rank();
  // Until the halo is known, every body of the host counts as ours.
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
  if (!host_.unwanted().empty()) SkipUnwanted(&next);
  if (communicator_->size() > 1) Recognise(&next);
  population_ = std::move(next);
}

void BodyMigration::Forget() {
  population_ = known_ = {};
  settled_ = false;
  host_.unwanted().clear();
}

/// Bodies that a failed step left in the host are not there for anybody.
void BodyMigration::SkipUnwanted(Population* next) {
  std::erase_if(host_.unwanted(), [&](std::int64_t id) { return next->RowOf(id) < 0; });
  std::vector<char> keep(next->size(), 1);
  for (const std::int64_t id : host_.unwanted()) keep[next->RowOf(id)] = 0;
  Filter(keep, next);
}

/// Which of the host's bodies are ours since the last Move(), which are ghosts, which are new, and which the user took away.
void BodyMigration::Recognise(Population* next) {
  if (settled_) known_ = std::move(population_);
  settled_ = false;
  newcomers_ = next->size();
  std::vector<char> keep(next->size(), 1);
  // Both tables ascend by id: merge them.
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
      for (const int rank : known_.holders[row]) removed_.push_back({id, rank});
    }
  }
  Filter(keep, next);
}

bool BodyMigration::HasGhost(std::int64_t id) const {
  const std::ptrdiff_t row = known_.RowOf(id);
  return row >= 0 && known_.owner[row] != communicator_->rank();
}

BodyMigration::Parcels BodyMigration::Pack(const HaloPlan& plan, const ImpulseCache& cache) const {
  Parcels parcels;
  ImpulseCache by_carrier = cache;
  std::stable_sort(by_carrier.contacts.begin(), by_carrier.contacts.end(),
                   [](const auto& a, const auto& b) { return a.carrier < b.carrier; });
  for (const HaloPlan::Send& send : plan.sends) {
    PutBody(population_, send.row, by_carrier, send.with_shapes ? adapter_->transport() : nullptr, &parcels[send.rank]);
  }
  for (const auto* removals : {&plan.removals, &removed_}) {
    for (const HaloPlan::Removal& removal : *removals) {
      if (removal.rank != communicator_->rank()) PutRemoval(removal.id, &parcels[removal.rank]);
    }
  }
  for (const auto& [rank, bytes] : parcels) CheckSize(bytes, rank);
  return parcels;
}

void BodyMigration::Unpack(const std::vector<Message>& incoming, ImpulseCache* cache, std::vector<Arrival>* arrivals,
                           std::vector<std::int64_t>* leaving) {
  // What leaves makes room, what comes is appended and sorted in: rows ascend by id on every rank.
  std::vector<char> keep(population_.size(), 1);
  for (const std::int64_t id : *leaving) keep[population_.RowOf(id)] = 0;
  Filter(keep, &population_);
  std::vector<std::int64_t> removals;
  for (const Message& message : incoming) TakeRecords(message.bytes, &population_, cache, arrivals, &removals);
  std::ranges::copy_if(removals, std::back_inserter(*leaving), [&](std::int64_t id) { return HasGhost(id); });
  SortById(&population_);
  const auto& id = population_.bodies.id;
  const auto twice = std::adjacent_find(id.begin(), id.end());
  if (twice != id.end()) RefuseBodyInSeveralHosts(*twice);
  cache->Sort();
}

void BodyMigration::Move(const std::vector<Pose>& detection, const Grid& grid, const Blocks& blocks, const Reach& reach,
                         ImpulseCache* cache) {
  migrated_ = 0;
  if (communicator_->size() == 1) return;
  HaloPlan plan;
  Parcels parcels;
  RunTogether(communicator_, [&] {
    plan = MakeHaloPlan(population_, detection, grid, blocks, reach, communicator_->rank());
    population_.owner = plan.owner;
    population_.holders = plan.holders;
    parcels = Pack(plan, *cache);
  });
  migrated_ = plan.migrated;
  for (std::vector<int>& holders : population_.holders) {
    if (holders.size() == 1) holders.clear();
  }
  std::vector<Message> outgoing;
  for (auto& [rank, bytes] : parcels) outgoing.push_back({rank, std::move(bytes)});
  const std::vector<Message> incoming = communicator_->Deliver(std::move(outgoing));

  std::vector<std::int64_t>& leaving = plan.leaving;
  std::vector<Arrival> arrivals;
  try {
    RunTogether(communicator_, [&] {
      Unpack(incoming, cache, &arrivals, &leaving);
      host_.Insert(&arrivals, [&](std::int64_t id) { return HasGhost(id); });
    });
  } catch (const Error&) {
    host_.Undo(&arrivals);
    throw;
  }
  settled_ = true;
  // Every host has what it needs: now, and no earlier, bodies go.
  std::vector<std::int64_t>& unwanted = host_.unwanted();
  unwanted.insert(unwanted.end(), leaving.begin(), leaving.end());
  std::erase_if(unwanted, [&](std::int64_t id) { return population_.RowOf(id) >= 0; });
  RunTogether(communicator_, [&] { host_.RemoveUnwanted(); });
}

}  // namespace nscdd
