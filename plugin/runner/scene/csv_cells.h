// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace nscdd {

/// A number as programs write it: 1.5, +1.5, 1,5 (digits on both sides of the comma), 1e-3, Fortran's 1.0D+00. What is too
/// small for a double becomes zero, or the nearest denormal. Nothing if it is no number, not finite, or too large.
std::optional<double> CsvNumber(std::string_view text);

/// An integer >= 0, also as 7.0 or 7.0e+00 (then up to 2^53, where doubles cease to tell integers apart).
std::optional<std::int64_t> CsvId(std::string_view text);

/// What stands between two fields of a line. Where it is a comma, numbers have decimal points, unless they are quoted.
enum class Separator { kComma, kSemicolon, kBlank };  ///< kBlank: any run of blanks and tabs

/// Without the blanks, tabs and carriage returns around it.
std::string_view Trim(std::string_view text);

/// Semicolon, if the line has one. Otherwise comma, if it has one and is not made of numbers with decimal commas between blanks
/// ("1,5 2 0,5"). Otherwise blank. What is in double quotes does not count.
Separator FindSeparator(std::string_view line);

/// The fields of a line, trimmed and without the double quotes around them. False if a quote is not closed.
bool SplitLine(std::string_view line, Separator separator, std::vector<std::string_view>* fields);

}  // namespace nscdd
