// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/contact_table.h"

namespace nscdd {

/// Gap [m] of contact `c` of the table after its bodies moved by theta dt V from the detection configuration: exact geometry,
/// not its linearisation. A flat side turns with its body. `shift_b` is image * period.
double FinalGap(const ContactTable& table, std::size_t c, const Pose& detection_a, const Pose& detection_b, const Pose& final_a,
                const Pose& final_b, double shift_b);

}  // namespace nscdd
