// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nscdd/platform_adapter.h"
#include "nscdd/time_stepper.h"

namespace nscdd {

/// What a step made of this rank's bodies and contacts.
struct StepOutcome {
  std::vector<BodyRecord> bodies;       ///< by id
  std::vector<ContactRecord> contacts;  ///< by (subdomain, key)

  bool IsFinite() const;
  /// Throws Error naming the first body whose position or velocity is not finite.
  void RequireFinite() const;
  /// Hands it to the platform.
  void Commit(PlatformAdapter* adapter) const;
};

}  // namespace nscdd
