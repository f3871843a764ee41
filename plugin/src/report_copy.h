// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/report.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// `report` as the C interface shows it; `reason` points into `report`, the header is left alone.
void CopyReport(const StepReport& report, nscdd_report* target);

}  // namespace nscdd
