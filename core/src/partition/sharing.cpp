// SPDX-License-Identifier: Apache-2.0
#include "partition/sharing.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "parallel/bytes.h"

namespace nscdd {

Sharing MakeSharing(std::size_t rows, const SubdomainPairs& pairs) {
  Sharing sharing;
  sharing.begin.assign(rows + 1, 0);
  for (const auto& [row, subdomain] : pairs) ++sharing.begin[row + 1];
  for (std::size_t row = 0; row < rows; ++row) sharing.begin[row + 1] += sharing.begin[row];
  sharing.subdomain.resize(pairs.size());
  std::vector<std::int32_t> next(sharing.begin.begin(), sharing.begin.end() - 1);
  for (const auto& [row, subdomain] : pairs) sharing.subdomain[next[row]++] = subdomain;
  // A few per row: sort them, drop those that are there twice, close the gaps.
  auto out = sharing.subdomain.begin();
  for (std::size_t row = 0; row < rows; ++row) {
    const auto first = sharing.subdomain.begin() + sharing.begin[row], last = sharing.subdomain.begin() + next[row];
    sharing.begin[row] = static_cast<std::int32_t>(out - sharing.subdomain.begin());
    std::sort(first, last);
    const auto end = std::unique(first, last);
    for (auto e = first; e != end; ++e) *out++ = *e;
  }
  sharing.begin[rows] = static_cast<std::int32_t>(out - sharing.subdomain.begin());
  sharing.subdomain.erase(out, sharing.subdomain.end());
  return sharing;
}

Sharing CompleteSharing(const Population& population, SubdomainPairs pairs, std::vector<std::uint8_t>* marks,
                        Communicator* communicator) {
  Sharing mine = MakeSharing(population.size(), pairs);
  if (communicator->size() == 1) return mine;
  // What our subdomains touch is told to every rank that holds the body.
  std::map<int, std::vector<std::byte>> parcels;
  for (std::size_t row = 0; row < population.size(); ++row) {
    for (const int rank : population.holders[row]) {
      if (rank == communicator->rank()) continue;
      for (const std::int32_t subdomain : mine.Of(row)) {
        ByteWriter out(&parcels[rank]);
        out.Put(population.bodies.id[row]);
        out.Put(subdomain);
        out.Put((*marks)[row]);
      }
    }
  }
  std::vector<Message> outgoing;
  for (auto& [rank, bytes] : parcels) outgoing.push_back({rank, std::move(bytes)});
  for (const Message& message : communicator->Deliver(std::move(outgoing))) {
    for (ByteReader in(message.bytes); !in.empty();) {
      const auto id = in.Get<std::int64_t>();
      const auto subdomain = in.Get<std::int32_t>();
      const auto row = static_cast<std::int32_t>(population.RowOf(id));
      (*marks)[row] |= in.Get<std::uint8_t>();
      pairs.emplace_back(row, subdomain);
    }
  }
  return MakeSharing(population.size(), pairs);
}

}  // namespace nscdd
