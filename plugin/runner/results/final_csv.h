// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "results/result_tables.h"
#include "results/results_folder.h"

namespace nscdd {

/// "wall" or "cluster"; nothing for a disk.
using RoleOfBody = std::function<std::string_view(std::int64_t id)>;

/// Writes final.csv: id,x,y,angle,vx,vy,spin,radius,kind of every body with 17 significant digits, by ascending id. Kind is
/// what `role` says on rank 0 or else free or prescribed; a role without words is a disk's. Collective; each rank gives the
/// bodies that it owns. Rank 0 never holds more than about `rows_at_a_time` of the others' rows. Throws Error on all ranks when
/// the file cannot be written or an id is there twice.
void WriteFinalCsv(ResultsFolder* folder, const GrainTable& grains, const RoleOfBody& role, int rows_at_a_time = 65536);

}  // namespace nscdd
