// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace nscdd {

/// A number as programs write it: 1.5, +1.5, 1,5 (digits on both sides of the comma), 1e-3, Fortran's 1.0D+00. What is too
/// small for a double becomes zero, or the nearest denormal. Nothing if it is no number, not finite, or too large.
std::optional<double> CsvNumber(std::string_view text);

/// An integer >= 0, also as 7.0 or 7.0e+00 (then up to 2^53, where doubles cease to tell integers apart).
std::optional<std::int64_t> CsvId(std::string_view text);

}  // namespace nscdd
