// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "problem/subdomain_problem.h"

namespace nscdd {

/// Solves packets of contacts one after the other (packet p: rows begin[p] to begin[p + 1]), four contacts at a time: the bits
/// of the plain loop over the rows, by the same operations in the same order in each lane.
template <class Row>
using PacketSweep = void (*)(const Row* rows, const std::int32_t* begin, std::size_t packets, const double* inverse_mass,
                             double* velocity, double* impulse);

/// The one for this processor; null where there is none.
template <class Row>
PacketSweep<Row> PacketSweepHere();

/// For AVX2.
void SweepPacketsAvx2(const NormalRow* rows, const std::int32_t* begin, std::size_t packets, const double* inverse_mass,
                      double* velocity, double* impulse);
void SweepPacketsAvx2(const FrictionRow* rows, const std::int32_t* begin, std::size_t packets, const double* inverse_mass,
                      double* velocity, double* impulse);

}  // namespace nscdd
