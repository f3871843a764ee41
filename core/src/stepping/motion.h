// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/communicator.h"
#include "partition/population.h"

namespace nscdd {

/// How far any point of body `row` moves at velocity `v` in `dt` [m]. Half-planes: their surface, turning aside.
double Excursion(const BodyTable& bodies, std::size_t row, const Twist& v, double dt);

/// What a stage of the step has shown of a rank's own bodies; rows ascend by id.
struct KnownMotion {
  std::vector<std::int64_t> id;
  std::vector<Twist> way;           ///< on which contacts are to be looked for
  std::vector<Twist> displacement;  ///< W, which tells how far
};

/// One of its columns for every row, FreeMotion() where nothing is known.
std::vector<Twist> MotionOf(const BodyTable& bodies, const KnownMotion& known, const std::vector<Twist>& column, double dt);

/// Reach of every row [m]: half the alert distance, or what its velocities cover, V_i, V_f and (once it is known to move
/// otherwise) W. With a `period` less than half of it beside the body, so that no disk meets its own image.
std::vector<double> ReachesOf(const BodyTable& bodies, const std::vector<Twist>& displacement, double alert, double period,
                              double dt);

/// Owners tell those who hold a ghost of a body its velocity. Collective.
void ShareMotion(const Population& population, Communicator* communicator, std::vector<Twist>* motion);

}  // namespace nscdd
