// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "results/rank_group.h"
#include "scene/body_definition.h"
#include "state/state_head.h"

namespace nscdd {

/// Collective. Writes a state file (README.md) to `path`: of each rank its bodies and its solver's state. The head is the same
/// on all ranks, but for `run`, of which rank 0's counts. Throws Error on all ranks when it cannot be written.
void WriteStateFile(const std::filesystem::path& path, const StateHead& head, const std::vector<BodyDefinition>& bodies,
                    std::span<const std::byte> solver_state, const RankGroup& ranks);

}  // namespace nscdd
