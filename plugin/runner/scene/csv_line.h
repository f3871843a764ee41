// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace nscdd {

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
