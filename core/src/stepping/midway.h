// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "partition/population.h"
#include "stepping/step_tables.h"

namespace nscdd {

/// Second order along the contacts: W of a hindered body becomes (V_i + W) / 2 in the directions that its active contacts leave
/// free, the spin of a disk among them, unless an open contact could not stand it. For bodies that no contact or contacts of
/// one normal act on, all of them in the subdomain of their home cell: others keep W, which is of first order.
void MoveMidway(const Population& population, double dt, int rank, StepTables* tables);

}  // namespace nscdd
