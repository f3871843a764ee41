// SPDX-License-Identifier: Apache-2.0
#include "stepping/setup_checks.h"

#include <fmt/format.h>

#include <cmath>

#include "nscdd/error.h"
#include "nscdd/option_table.h"
#include "stepping/contact_checks.h"

namespace nscdd {

AdapterDescription CheckSetup(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter,
                              int ranks) {
  CheckSettings({stepping, algorithm});
  AdapterDescription description = adapter->Describe();
  CheckPeriod(description);
  // A subdomain is never cut: ranks without one would have nothing to do.
  const PartitionOptions partition = PartitionOf(algorithm);
  const int subdomains = partition.nx * partition.ny;
  if (ranks > subdomains) {
    throw Error(
        fmt::format("{} ranks share {} subdomain{}; a rank needs at least one: start at most {} or ask for more subdomains",
                    ranks, subdomains, subdomains == 1 ? "" : "s", subdomains));
  }
  if (ranks > 1 && adapter->transport() == nullptr) {
    throw Error(
        fmt::format("adapter '{}' cannot move bodies between ranks (no distributed_bodies); start one rank", description.name));
  }
  return description;
}

void CheckTimeStep(double dt) {
  if (std::isfinite(dt) && dt > 0.0) return;
  throw Error(fmt::format("the time step is {} s; it must be positive and finite", dt));
}

}  // namespace nscdd
