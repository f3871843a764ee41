// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace nscdd {

/// The name of `known` that needs the fewest typing corrections to become `word`; empty if none is near.
std::string NearestName(std::string_view word, std::span<const std::string> known);

/// "did you mean 'dt'?" or, with nothing near, "`noun` are dt, steps, theta".
std::string Suggestion(std::string_view word, std::span<const std::string> known, std::string_view noun);

/// `text` with a full stop, unless it ends with a question.
std::string Sentence(std::string text);

}  // namespace nscdd
