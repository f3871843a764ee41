// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nscdd/reference/world.h"

namespace nscdd {

/// SplitMix64's finaliser: the same on every machine and standard library.
constexpr std::uint64_t MixBits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// Number `index` of the sequence `seed`, uniform in [0, 1); any of them without the ones before.
constexpr double UniformNumber(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t bits = MixBits(MixBits(seed) + (index + 1) * 0x9E3779B97F4A7C15u);
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

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

/// Disks laid under vertical gravity one after the other: each is dropped somewhere and takes the lowest place nearby where it
/// rests on two earlier ones or on one and a side. Neighbours touch, two contacts per disk, and nothing overlaps.
struct Deposition {
  double left = 0.0, right = 0.0;             ///< [m] vertical sides
  double bottom = 0.0;                        ///< [m] flat floor
  double min_radius = 0.0, max_radius = 0.0;  ///< [m] radii are uniform in between; the larger one fits between the sides
  std::uint64_t seed = 0;
};

/// Lays the disks in order. Remembers only the surface, so its memory is that of one layer; about 1 microsecond per disk.
class DepositionGenerator {
 public:
  explicit DepositionGenerator(const Deposition& deposition) : deposition_(deposition) {}

  /// The next disk, in the world frame.
  reference::Disk Next();

 private:
  struct Seat {
    Vec2 centre;
    std::size_t first;  ///< surface disks [first, last) disappear below the new one
    std::size_t last;
  };
  std::optional<Vec2> OnFloor(double radius) const;
  std::optional<Vec2> Between(std::ptrdiff_t left, std::size_t right, double radius) const;
  bool IsAbove(Vec2 centre) const;
  bool IsFree(Vec2 centre, double radius) const;
  std::size_t FirstFrom(double x) const;
  std::optional<Seat> LowestSeat(double from, double to, double radius) const;
  Seat OnTop(double radius) const;

  Deposition deposition_;
  std::vector<reference::Disk> surface_;  ///< ascending in x
  bool floor_is_full_ = false;
  std::uint64_t index_ = 0;
};

}  // namespace nscdd
