// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "nscdd/contact_table.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// What contact arrays must contain beside the physics.
struct ContactArrayNeeds {
  bool keys = true;   ///< shape_a and shape_b may not be null, image is copied if there; else all of them are zero
  bool sites = true;  ///< site may not be null
};

/// Copies contact arrays of the C interface. `who` begins each sentence ("host 'x', function detect_contacts"). Throws Error on
/// null arrays, absurd counts and rows outside [0, body_count). Whether the numbers make sense is left to the core, which
/// checks every adapter's tables.
void CopyContacts(const nscdd_contacts& source, std::size_t body_count, ContactArrayNeeds needs, const std::string& who,
                  ContactTable* contacts);

}  // namespace nscdd
