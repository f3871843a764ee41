// SPDX-License-Identifier: Apache-2.0
#include "report_copy.h"

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace nscdd {
namespace {

static_assert(static_cast<int>(SolveStatus::kConverged) == NSCDD_CONVERGED);
static_assert(static_cast<int>(SolveStatus::kIterationLimit) == NSCDD_ITERATION_LIMIT);
static_assert(static_cast<int>(SolveStatus::kStalled) == NSCDD_STALLED);
static_assert(static_cast<int>(SolveStatus::kDiverged) == NSCDD_DIVERGED);
static_assert(static_cast<int>(SolveStatus::kIncomplete) == NSCDD_INCOMPLETE);
static_assert(static_cast<int>(SolveStatus::kFixed) == NSCDD_FIXED);
static_assert(kStatuses.size() == 6);

// The layout that hosts of minors 0 to 2 were compiled with.
static_assert(offsetof(nscdd_report, status) == 16 && offsetof(nscdd_report, reason) == 24);
static_assert(offsetof(nscdd_report, nat) == 96 && offsetof(nscdd_report, worst_body_b) == 160);
static_assert(offsetof(nscdd_report, mean_interpenetration) == 248 && offsetof(nscdd_report, seconds_total) == 376);
static_assert(offsetof(nscdd_report, acceleration_restarts) == 440);
constexpr std::uint64_t kSizeOfMinor0 = 448;

constexpr std::uint32_t kMinorOfFixed = 2;
constexpr std::uint32_t kMinorOfGrowth = 3;

#define NSCDD_COUNT(type, name, kind, unit, help) +1
constexpr std::size_t kFigures = NSCDD_FIGURES(NSCDD_COUNT, NSCDD_COUNT, NSCDD_COUNT);
#undef NSCDD_COUNT
static_assert(sizeof(nscdd_report) == sizeof(nscdd_header) + 8 * kFigures,
              "nscdd_report has a member of 8 bytes for each line of figures.h, and no other");

}  // namespace

std::uint64_t ReportSize(std::uint32_t abi_minor) { return abi_minor < kMinorOfGrowth ? kSizeOfMinor0 : sizeof(nscdd_report); }

void CopyReport(const StepReport& report, nscdd_report* target) {
  const char* end = reinterpret_cast<const char*>(target) + target->header.struct_size;
  const auto copy = [&](const Figure&, const auto& from, auto& to) {
    using To = std::decay_t<decltype(to)>;
    if (reinterpret_cast<const char*>(&to + 1) > end) return;
    if constexpr (std::same_as<To, const char*>) {
      to = from.c_str();
    } else {
      static_assert(std::is_floating_point_v<To> == std::is_floating_point_v<std::decay_t<decltype(from)>>);
      to = static_cast<To>(from);
    }
  };
  ForEachFigure(copy, report, *target);
  if (report.solve.status == SolveStatus::kFixed && target->header.abi_minor < kMinorOfFixed) {
    target->status = NSCDD_ITERATION_LIMIT;
  }
}

}  // namespace nscdd
