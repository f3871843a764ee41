// SPDX-License-Identifier: Apache-2.0
#include "stepping/saved_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <unordered_map>

#include "nscdd/error.h"
#include "parallel/agreement.h"
#include "parallel/bytes.h"

namespace nscdd {
namespace {

constexpr std::uint64_t kMark = 0x325453444453434e;  // "NCSDDST2": these bytes are a saved state of this layout
constexpr std::int64_t kMostSteps = std::int64_t{1} << 62;

/// The beginning of every part: equal bytes in all parts of one moment.
struct Head {
  std::uint64_t mark = kMark;
  std::int32_t nx = 1, ny = 1;
  std::int64_t ranks = 1;  ///< that wrote a part
  StepperState state;
};
static_assert(sizeof(StepperState) == 32 + sizeof(Grid) && sizeof(Grid) == 64, "no padding: the bytes are compared");

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw Error(sentence);
}

bool IsFinite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

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

void CheckHead(const Head& head, int nx, int ny) {
  Require(head.mark == kMark, "these bytes are no saved state of a time stepper of this version");
  Require(head.nx == nx && head.ny == ny,
          fmt::format("the saved state is one of {}x{} subdomains, this solver has {}x{}; continue with the same partition",
                      head.nx, head.ny, nx, ny));
  const StepperState& s = head.state;
  const bool is_cut = s.grid.nx() == nx && s.grid.ny() == ny;
  Require(head.ranks > 0 && s.step >= 0 && s.step < kMostSteps && std::isfinite(s.time) && std::isfinite(s.alert) &&
              std::isfinite(s.cached_dt) && s.cached_dt >= 0.0 && IsFinite(s.grid.low()) && IsFinite(s.grid.high()) &&
              (is_cut || s.step == 0),
          "the saved state is damaged: its counters make no sense; take another one");
}

void CheckImpulses(const ImpulseCache& cache) {
  const auto is_damaged = [](const auto& entries, auto sum_of) {
    return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return !std::isfinite(sum_of(entry)); });
  };
  Require(
      !is_damaged(cache.contacts, [](const CachedImpulse& e) { return e.impulse.x + e.impulse.y; }) &&
          !is_damaged(cache.interfaces, [](const CachedInterfaceImpulse& e) { return e.force[0] + e.force[1] + e.force[2]; }),
      "the saved state is damaged: an impulse in it is not finite; take another one");
}

/// The head and the rank of one part.
std::pair<Head, std::int64_t> ReadPart(std::span<const std::byte> bytes, int nx, int ny, ImpulseCache* cache) {
  ByteReader in(bytes);
  const auto head = in.Get<Head>();
  CheckHead(head, nx, ny);
  const auto rank = in.Get<std::int64_t>();
  GetImpulses(&in, cache);
  Require(in.empty(), "the saved state is longer than it says it is");
  CheckImpulses(*cache);
  return {head, rank};
}

bool IsSame(const Head& a, const Head& b) { return std::memcmp(&a, &b, sizeof(Head)) == 0; }

/// The head of the lowest rank that was given a part.
Head AgreeOnHead(std::span<const Head> mine, Communicator* communicator) {
  double speaker = mine.empty() ? communicator->size() : communicator->rank();
  communicator->AllReduceMin({&speaker, 1});
  Require(speaker < communicator->size(), "no saved state was given to any rank");
  std::vector<std::byte> bytes;
  if (speaker == communicator->rank()) ByteWriter(&bytes).Put(mine.front());
  communicator->Broadcast(static_cast<int>(speaker), &bytes);
  return ByteReader(bytes).Get<Head>();
}

void CheckComplete(std::int64_t ranks, std::vector<double> parts) {
  std::sort(parts.begin(), parts.end());
  bool is_complete = parts.size() == static_cast<std::size_t>(ranks);
  for (std::size_t i = 0; is_complete && i < parts.size(); ++i) is_complete = parts[i] == static_cast<double>(i);
  Require(is_complete,
          fmt::format("{} ranks saved the state and {} parts of it were given; give the part of every rank, each to one "
                      "rank",
                      ranks, parts.size()));
}

struct Mail {
  std::vector<std::int64_t> owned;
  ImpulseCache cache;
};

using MailByRank = std::map<int, Mail>;

/// Delivers the mail; one's own stays here. Returns what came, by sender.
MailByRank Post(MailByRank mail, Communicator* communicator) {
  MailByRank received;
  std::vector<Message> outgoing;
  for (auto& [rank, letter] : mail) {
    if (rank == communicator->rank()) {
      received[rank] = std::move(letter);
      continue;
    }
    ByteWriter out(&outgoing.emplace_back(Message{rank, {}}).bytes);
    out.PutSpan(std::span<const std::int64_t>(letter.owned));
    PutImpulses(letter.cache, &out);
  }
  for (const Message& message : communicator->Deliver(std::move(outgoing))) {
    ByteReader in(message.bytes);
    Mail& letter = received[message.rank];
    letter.owned = in.GetVector<std::int64_t>();
    GetImpulses(&in, &letter.cache);
  }
  return received;
}

/// Puts each entry into the mail to the rank that `rank_of` its body names; -1: nowhere.
template <class RankOf>
void Address(const ImpulseCache& cache, RankOf rank_of, MailByRank* mail) {
  for (const CachedImpulse& entry : cache.contacts) {
    if (const int rank = rank_of(entry.carrier); rank >= 0) (*mail)[rank].cache.contacts.push_back(entry);
  }
  for (const CachedInterfaceImpulse& entry : cache.interfaces) {
    if (const int rank = rank_of(entry.body); rank >= 0) (*mail)[rank].cache.interfaces.push_back(entry);
  }
}

}  // namespace

std::vector<std::byte> WriteState(const StepperState& state, const ImpulseCache& cache, int nx, int ny,
                                  const Communicator& communicator) {
  std::vector<std::byte> bytes;
  ByteWriter out(&bytes);
  out.Put(Head{kMark, nx, ny, communicator.size(), state});
  out.Put(static_cast<std::int64_t>(communicator.rank()));
  PutImpulses(cache, &out);
  return bytes;
}

StepperState ReadStates(std::span<const std::span<const std::byte>> parts, int nx, int ny, Communicator* communicator,
                        ImpulseCache* cache) {
  std::vector<Head> heads;
  std::vector<double> ranks;
  RunTogether(communicator, [&] {
    for (const auto part : parts) {
      const auto [head, rank] = ReadPart(part, nx, ny, cache);
      heads.push_back(head);
      ranks.push_back(static_cast<double>(rank));
    }
  });
  const Head common = AgreeOnHead(heads, communicator);
  RunTogether(communicator, [&] {
    const bool same = std::all_of(heads.begin(), heads.end(), [&](const Head& head) { return IsSame(head, common); });
    Require(same, "the parts of the saved state are of different moments or runs; give those that were saved together");
  });
  CheckComplete(common.ranks, communicator->AllGather(ranks));
  cache->dt = common.state.cached_dt;
  cache->Sort();
  return common.state;
}

void DeliverToOwners(std::span<const std::int64_t> owned, Communicator* communicator, ImpulseCache* cache) {
  const int ranks = communicator->size();
  if (ranks == 1) return;
  const auto clerk = [ranks](std::int64_t id) {
    return static_cast<int>(static_cast<std::uint64_t>(id) % static_cast<std::uint64_t>(ranks));
  };
  MailByRank to_clerks;
  for (const std::int64_t id : owned) to_clerks[clerk(id)].owned.push_back(id);
  Address(*cache, clerk, &to_clerks);
  const MailByRank at_clerk = Post(std::move(to_clerks), communicator);
  std::unordered_map<std::int64_t, int> owner;
  for (const auto& [rank, letter] : at_clerk) {
    for (const std::int64_t id : letter.owned) owner[id] = rank;
  }
  MailByRank to_owners;
  for (const auto& [rank, letter] : at_clerk) {
    Address(
        letter.cache, [&](std::int64_t id) { return owner.contains(id) ? owner[id] : -1; }, &to_owners);
  }
  cache->contacts.clear();
  cache->interfaces.clear();
  for (const auto& [rank, letter] : Post(std::move(to_owners), communicator)) cache->Append(letter.cache);
  cache->Sort();
}

}  // namespace nscdd
