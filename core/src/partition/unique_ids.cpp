// SPDX-License-Identifier: Apache-2.0
#include "partition/unique_ids.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "nscdd/agreement.h"
#include "nscdd/error.h"
#include "parallel/bytes.h"

namespace nscdd {

void RefuseBodyInSeveralHosts(std::int64_t id) {
  throw Error(
      fmt::format("body {} is in the hosts of several ranks; ids are unique and every new body is in exactly one host, the "
                  "solver makes the ghosts",
                  id));
}

void CheckIdsAreUnique(const std::vector<std::int64_t>& ids, Communicator* communicator) {
  const int ranks = communicator->size(), me = communicator->rank();
  if (ranks == 1) return;
  // Nobody knows all ids: equal ones meet on the rank that is responsible for them.
  std::vector<std::vector<std::int64_t>> told(ranks);
  for (const std::int64_t id : ids) told[id % ranks].push_back(id);
  std::vector<std::int64_t> met = std::move(told[me]);
  std::vector<Message> outgoing;
  for (int rank = 0; rank < ranks; ++rank) {
    if (rank == me || told[rank].empty()) continue;
    ByteWriter(&outgoing.emplace_back(Message{rank, {}}).bytes).PutSpan(std::span<const std::int64_t>(told[rank]));
  }
  for (const Message& message : communicator->Deliver(std::move(outgoing))) {
    const auto more = ByteReader(message.bytes).GetVector<std::int64_t>();
    met.insert(met.end(), more.begin(), more.end());
  }
  RunTogether(communicator, [&] {
    std::sort(met.begin(), met.end());
    const auto twice = std::adjacent_find(met.begin(), met.end());
    if (twice != met.end()) RefuseBodyInSeveralHosts(*twice);
  });
}

}  // namespace nscdd
