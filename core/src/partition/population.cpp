// SPDX-License-Identifier: Apache-2.0
#include "partition/population.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace nscdd {
namespace {

template <class T>
void Permute(const std::vector<std::size_t>& order, std::vector<T>* column) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t i : order) sorted.push_back(std::move((*column)[i]));
  *column = std::move(sorted);
}

}  // namespace

std::ptrdiff_t Population::RowOf(std::int64_t id) const {
  const auto at = std::lower_bound(bodies.id.begin(), bodies.id.end(), id);
  return at != bodies.id.end() && *at == id ? at - bodies.id.begin() : -1;
}

void SortById(Population* p) {
  const auto& id = p->bodies.id;
  if (std::is_sorted(id.begin(), id.end())) return;
  std::vector<std::size_t> order(id.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
  ForEachColumn(p->bodies, [&](auto& column) { Permute(order, &column); });
  Permute(order, &p->owner);
  Permute(order, &p->holders);
}

void Filter(const std::vector<char>& keep, Population* p) {
  const auto filter = [&](auto& column) {
    std::size_t out = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      if (!keep[i]) continue;
      if (out != i) column[out] = std::move(column[i]);
      ++out;
    }
    column.resize(out);
  };
  ForEachColumn(p->bodies, filter);
  filter(p->owner);
  filter(p->holders);
}

}  // namespace nscdd
