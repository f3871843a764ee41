#pragma once

#include <span>
#include <string>
#include <string_view>

namespace nscdd {

/// The name of `known` that needs the fewest typing corrections to become `word`; empty if none is near.
std::string NearestName(std::string_view word, std::span<const std::string> known);

/// "perhaps 'dt' is meant" or, with nothing near, "`noun` are dt, steps, theta".
std::string Suggestion(std::string_view word, std::span<const std::string> known, std::string_view noun);

}  // namespace nscdd
