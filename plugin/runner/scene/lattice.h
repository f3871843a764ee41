// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nscdd/reference/world.h"

namespace nscdd {

/// Disks on a jittered square or hexagonal lattice, filled row by row from below.
struct Lattice {
  double left = 0.0, right = 0.0;             ///< [m] every disk fits between them
  double bottom = 0.0;                        ///< [m] no disk goes below
  double min_radius = 0.0, max_radius = 0.0;  ///< [m] radii are uniform in between
  double spacing = 0.0;                       ///< [m] between neighbours in a row, before the jitter
  double jitter = 0.0;                        ///< [m] largest displacement of a centre in x and in y
  bool hexagonal = false;
  std::uint64_t seed = 0;
};

/// Disks in a full row; less than 1 when not even one fits.
std::int64_t LatticeColumns(const Lattice& lattice);

/// Disk number `index` >= 0, in the world frame. Depends on nothing but its arguments.
reference::Disk LatticeDisk(const Lattice& lattice, std::int64_t index);

}  // namespace nscdd
