// SPDX-License-Identifier: Apache-2.0
#include "stepping/saved_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nscdd/agreement.h"
#include "nscdd/error.h"
#include "parallel/bytes.h"

namespace nscdd {
namespace {

// "NCSDDST" and the number of the layout.
constexpr std::uint64_t kFamily = 0x005453444453434e, kFamilyBits = 0x00ffffffffffffff;
constexpr std::uint64_t kLayout = '3';
constexpr std::int64_t kMostSteps = std::int64_t{1} << 62;

/// The beginning of every part: equal in all parts of one moment.
struct Head {
  std::int32_t nx = 1, ny = 1;
  std::int64_t ranks = 1;  ///< that wrote a part
  StepperState state;
};

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw Error(sentence);
}

bool IsFinite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

void PutGrid(const Grid& grid, ByteWriter* out) {
  out->Put(static_cast<std::int32_t>(grid.nx()));
  out->Put(static_cast<std::int32_t>(grid.ny()));
  out->Put(grid.low());
  out->Put(grid.high());
  out->Put(grid.period());
}

Grid GetGrid(ByteReader* in) {
  const auto nx = in->Get<std::int32_t>(), ny = in->Get<std::int32_t>();
  const auto low = in->Get<Vec2>(), high = in->Get<Vec2>();
  const auto period = in->Get<double>();
  Require(nx >= 1 && ny >= 1 && IsFinite(low) && IsFinite(high) && period >= 0.0 && std::isfinite(period),
          "the saved state is damaged: its cuts make no sense; take another one");
  Grid grid(low, high, nx, ny);
  if (period > 0.0) grid.SetPeriod(low.x, period);
  return grid;
}

std::vector<std::byte> HeadBytes(const Head& head) {
  std::vector<std::byte> bytes;
  ByteWriter out(&bytes);
  out.Put(kFamily | kLayout << 56);
  out.Put(head.nx);
  out.Put(head.ny);
  out.Put(head.ranks);
  out.Put(head.state.step);
  out.Put(head.state.time);
  out.Put(head.state.alert);
  out.Put(head.state.cached_dt);
  PutGrid(head.state.grid, &out);
  return bytes;
}

Head GetHead(ByteReader* in) {
  const auto mark = in->Get<std::uint64_t>();
  Require((mark & kFamilyBits) == kFamily, "these bytes are no saved state of a time stepper");
  Require(
      mark >> 56 == kLayout,
      "these bytes are a saved state of another version of this program; continue with the version that wrote them, or begin "
      "the run anew");
  Head head;
  head.nx = in->Get<std::int32_t>();
  head.ny = in->Get<std::int32_t>();
  head.ranks = in->Get<std::int64_t>();
  head.state.step = in->Get<std::int64_t>();
  head.state.time = in->Get<double>();
  head.state.alert = in->Get<double>();
  head.state.cached_dt = in->Get<double>();
  head.state.grid = GetGrid(in);
  return head;
}

void CheckHead(const Head& head) {
  const StepperState& s = head.state;
  const bool is_cut = s.grid.nx() == head.nx && s.grid.ny() == head.ny;
  Require(head.ranks > 0 && s.step >= 0 && s.step < kMostSteps && std::isfinite(s.time) && std::isfinite(s.alert) &&
              std::isfinite(s.cached_dt) && s.cached_dt >= 0.0 && (is_cut || s.step == 0),
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

/// The head of one part; adds its rank and impulses to the others.
Head ReadPart(std::span<const std::byte> bytes, std::vector<double>* ranks, ImpulseCache* cache) {
  ByteReader in(bytes);
  const Head head = GetHead(&in);
  CheckHead(head);
  ranks->push_back(static_cast<double>(in.Get<std::int64_t>()));
  GetImpulses(&in, cache);
  Require(in.empty(), "the saved state is longer than it says it is");
  CheckImpulses(*cache);
  return head;
}

/// The head of the lowest rank that was given a part.
Head AgreeOnHead(std::span<const Head> mine, Communicator* communicator) {
  double speaker = mine.empty() ? communicator->size() : communicator->rank();
  communicator->AllReduceMin({&speaker, 1});
  Require(speaker < communicator->size(), "no saved state was given to any rank");
  std::vector<std::byte> bytes;
  if (speaker == communicator->rank()) bytes = HeadBytes(mine.front());
  communicator->Broadcast(static_cast<int>(speaker), &bytes);
  ByteReader in(bytes);
  return GetHead(&in);
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

}  // namespace

std::vector<std::byte> WriteState(const StepperState& state, const ImpulseCache& cache, const PartitionOptions& partition,
                                  const Communicator& communicator) {
  std::vector<std::byte> bytes = HeadBytes({partition.nx, partition.ny, communicator.size(), state});
  ByteWriter out(&bytes);
  out.Put(static_cast<std::int64_t>(communicator.rank()));
  PutImpulses(cache, &out);
  return bytes;
}

StepperState ReadStates(std::span<const std::span<const std::byte>> parts, const PartitionOptions& partition,
                        const AdapterDescription& platform, Communicator* communicator, ImpulseCache* cache) {
  std::vector<Head> heads;
  std::vector<double> ranks;
  RunTogether(communicator, [&] {
    for (const auto part : parts) heads.push_back(ReadPart(part, &ranks, cache));
  });
  // Parts may be many or none on a rank (another number of ranks goes on): all heads must say the same.
  const Head common = AgreeOnHead(heads, communicator);
  RunTogether(communicator, [&] {
    const std::vector<std::byte> bytes = HeadBytes(common);
    const bool same = std::all_of(heads.begin(), heads.end(), [&](const Head& head) { return HeadBytes(head) == bytes; });
    Require(same, "the parts of the saved state are of different moments or runs; give those that were saved together");
  });
  CheckComplete(common.ranks, communicator->AllGather(ranks));
  const StepperState& state = common.state;
  Require(state.step == 0 || state.grid.HasPeriod(platform.period_origin, platform.period),
          fmt::format("the saved state is of a world with another period than {} m from {} m (0: none)", platform.period,
                      platform.period_origin));
  if (common.nx != partition.nx || common.ny != partition.ny) cache->interfaces.clear();
  cache->Sort();
  return state;
}

}  // namespace nscdd
