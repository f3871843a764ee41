// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nscdd/host/solver.h"
#include "nscdd/platform_adapter.h"
#include "results/rank_group.h"
#include "results/result_tables.h"
#include "scene/body_stream.h"

namespace nscdd {

/// This rank's bodies and contacts after the last step, of length `dt` [s], from the plugin's tables.
GrainTable MakeGrainTable(const Solver& solver);
ContactRows MakeContactRows(const Solver& solver, double dt);

/// The bodies of this rank's host before the first step: no contacts, hence multiplicity 0, and no partition, subdomain -1.
GrainTable MakeGrainTable(PlatformAdapter* adapter);
/// [m] of the free bodies of all ranks, to 2^-32 of the largest radius. Collective.
double MeanRadius(const GrainTable& grains, const RankGroup& ranks);

/// Adds the shapes of a body that is more than one centred disk.
void AddShapes(const BodyDefinition& body, ShapeTable* shapes);

/// Contacts of this rank that were deeper than `depth` [m] at the detection.
struct DeepContacts {
  std::int64_t count = 0;
  double deepest = 0.0;  ///< [m]
};
DeepContacts FindDeepContacts(const Solver& solver, double depth);

}  // namespace nscdd
