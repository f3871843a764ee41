// SPDX-License-Identifier: Apache-2.0
#include "scene/lattice.h"

#include <algorithm>
#include <cmath>

#include "scene/random.h"

namespace nscdd {

std::int64_t LatticeColumns(const Lattice& lattice) {
  const double shift = lattice.hexagonal ? 0.5 * lattice.spacing : 0.0;
  const double room = lattice.right - lattice.left - 2.0 * (lattice.max_radius + lattice.jitter) - shift;
  if (room < 0.0) return 0;
  return static_cast<std::int64_t>(std::min(std::floor(room / lattice.spacing), 1e15)) + 1;
}

reference::Disk LatticeDisk(const Lattice& lattice, std::int64_t index) {
  const std::int64_t columns = LatticeColumns(lattice);
  const std::int64_t row = index / columns;
  const double row_height = lattice.hexagonal ? 0.5 * std::sqrt(3.0) * lattice.spacing : lattice.spacing;
  const double shift = lattice.hexagonal && row % 2 == 1 ? 0.5 * lattice.spacing : 0.0;
  const double margin = lattice.max_radius + lattice.jitter;
  const auto number = [&](std::uint64_t k) { return UniformNumber(lattice.seed, 3 * static_cast<std::uint64_t>(index) + k); };
  reference::Disk disk;
  disk.radius = lattice.min_radius + (lattice.max_radius - lattice.min_radius) * number(0);
  disk.centre.x = lattice.left + margin + shift + lattice.spacing * static_cast<double>(index % columns) +
                  lattice.jitter * (2.0 * number(1) - 1.0);
  disk.centre.y = lattice.bottom + margin + row_height * static_cast<double>(row) + lattice.jitter * (2.0 * number(2) - 1.0);
  return disk;
}

}  // namespace nscdd
