// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "results/result_tables.h"
#include "results/results_folder.h"

namespace nscdd {

/// Writes final.csv: id,x,y,angle,vx,vy,spin of every body with 17 significant digits, by ascending id. Collective; each rank
/// gives the bodies that it owns. Rank 0 never holds more than about `rows_at_a_time` of the others' rows.
/// Throws Error on all ranks when the file cannot be written or an id is there twice.
void WriteFinalCsv(ResultsFolder* folder, const GrainTable& grains, int rows_at_a_time = 65536);

}  // namespace nscdd
