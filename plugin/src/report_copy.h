// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/report.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// Bytes of nscdd_report that an ABI minor prescribes.
std::uint64_t ReportSize(std::uint32_t abi_minor);

/// `report` as the C interface shows it, as far as target->header.struct_size goes; `reason` points into `report`, the header
/// is left alone.
void CopyReport(const StepReport& report, nscdd_report* target);

}  // namespace nscdd
