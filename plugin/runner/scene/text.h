// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "text/nearest_name.h"

namespace nscdd {

/// Line (from 1) of the first byte that is not UTF-8 (RFC 3629); 0 if all are.
int FirstLineOutsideUtf8(std::string_view text);

/// Has it control characters (below U+0020, or U+007F)?
bool HasControls(std::string_view text);

/// The text fit for one line of a terminal: control characters and bytes that are no UTF-8 become '?', and of more than 1000
/// bytes the middle is left out.
std::string Printable(std::string_view text);

/// "did you mean 'dt'?" or, with nothing near, "`noun` are dt, steps, theta".
std::string Suggestion(std::string_view word, std::span<const std::string> known, std::string_view noun);

/// `text` with a full stop, unless it ends with a question.
std::string Sentence(std::string text);

}  // namespace nscdd
