// SPDX-License-Identifier: Apache-2.0
#include "problem/interface_map.h"

#include <algorithm>
#include <map>
#include <utility>

namespace nscdd {
namespace {

struct LocalCopy {
  std::int32_t row, subdomain, problem, body;
};

/// Copies of shared bodies in this rank's problems, by (row, subdomain).
std::vector<LocalCopy> SharedCopies(const std::vector<SubdomainProblem>& problems, const Sharing& sharing) {
  std::vector<LocalCopy> copies;
  for (std::size_t p = 0; p < problems.size(); ++p) {
    for (std::size_t b = 0; b < problems[p].body_count(); ++b) {
      const std::int32_t row = problems[p].body[b];
      if (sharing.Multiplicity(row) < 2) continue;
      copies.push_back({row, problems[p].subdomain, static_cast<std::int32_t>(p), static_cast<std::int32_t>(b)});
    }
  }
  std::sort(copies.begin(), copies.end(), [](const LocalCopy& a, const LocalCopy& b) {
    return std::pair(a.row, a.subdomain) < std::pair(b.row, b.subdomain);
  });
  return copies;
}

}  // namespace

InterfaceMap MakeInterfaceMap(const std::vector<SubdomainProblem>& problems, const Sharing& sharing, const Blocks& blocks,
                              int rank) {
  InterfaceMap map;
  const std::vector<LocalCopy> local = SharedCopies(problems, sharing);
  if (local.empty()) return map;
  std::map<int, InterfaceMap::Neighbour> neighbours;
  map.slot_begin.push_back(0);
  // One round per interface body: a slot for each of its copies, wherever they are.
  for (auto copy = local.begin(); copy != local.end();) {
    const std::int32_t row = copy->row, first = map.slot_begin.back();
    const auto subdomains = sharing.Of(row);
    std::vector<std::int32_t> ours, ranks;
    for (std::size_t k = 0; k < subdomains.size(); ++k) {
      const std::int32_t slot = first + static_cast<std::int32_t>(k);
      const int owner = blocks.RankOf(subdomains[k]);
      if (owner == rank) {
        ours.push_back(slot);
        map.copies.push_back({copy->problem, copy->body, slot});
        ++copy;
      } else {
        neighbours[owner].receive.push_back(slot);
        ranks.push_back(owner);
      }
    }
    // Whoever has another copy needs ours, once.
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    for (const int other : ranks) {
      auto& send = neighbours[other].send;
      send.insert(send.end(), ours.begin(), ours.end());
    }
    map.row.push_back(row);
    map.slot_begin.push_back(first + static_cast<std::int32_t>(subdomains.size()));
  }
  for (auto& [other, neighbour] : neighbours) {
    neighbour.rank = other;
    map.neighbours.push_back(std::move(neighbour));
  }
  return map;
}

}  // namespace nscdd
