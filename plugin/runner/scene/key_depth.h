// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace nscdd {

/// Line (from 1) of the first dotted key of a TOML text with more than `most` parts; 0 if there is none. A parser makes nested
/// tables of it, and recursion through them may exhaust the stack. Texts need not be valid.
int FirstLineOfDeepKey(std::string_view text, int most);

}  // namespace nscdd
