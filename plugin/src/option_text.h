// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nscdd/option_table.h"

namespace nscdd {

/// The value that a text stands for, within the option's limits; `value` is any of the option's kind. Throws Error: "option 'x'
/// is 'y', must be ...".
OptionValue ParseOption(const Option& option, std::string_view text, OptionValue value);

}  // namespace nscdd
