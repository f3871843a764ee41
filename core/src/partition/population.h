// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nscdd/body_table.h"

namespace nscdd {

/// The bodies that a rank holds: those it owns (their home cell is one of its subdomains) and ghosts, which other ranks own but
/// which may take part in contacts of its subdomains. Rows ascend by id.
struct Population {
  BodyTable bodies;
  std::vector<int> owner;                 ///< rank, of each row
  std::vector<std::vector<int>> holders;  ///< ranks that hold it, ascending, owner included; empty: the owner alone

  std::size_t size() const { return owner.size(); }
  std::ptrdiff_t RowOf(std::int64_t id) const;  ///< -1 if it is not here
};

/// Rows by ascending id.
void SortById(Population* population);

/// Drops the rows where keep is 0.
void Filter(const std::vector<char>& keep, Population* population);

/// Calls f on each column of the table.
template <class Table, class Function>
void ForEachColumn(Table& t, Function&& f) {
  f(t.id);
  f(t.kind);
  f(t.mass);
  f(t.inertia);
  f(t.radius);
  f(t.bounding_radius);
  f(t.pose);
  f(t.velocity);
  f(t.force);
}

}  // namespace nscdd
