// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nscdd/options.h"

namespace nscdd {

/// Inclusive limits of a number that an option accepts; below_limit says that the lower one itself is refused.
struct Range {
  double least = -1e308;
  double most = 1e308;
  bool least_excluded = false;
};

/// Values of options cross the C interface as text. Each Parse throws Error: "option 'x' is 'y': ..., must be ...".
double ParseReal(std::string_view option, std::string_view text, const Range& range);
int ParseInteger(std::string_view option, std::string_view text, const Range& range);
bool ParseBool(std::string_view option, std::string_view text);
/// "4x2" into nx and ny, each from 1 to 100000, at most 10 million together; the rest of the struct is kept.
void ParseGrid(std::string_view option, std::string_view text, PartitionOptions* grid);
/// Position of `text` among `choices`.
std::size_t ParseChoice(std::string_view option, std::string_view text, const std::vector<std::string>& choices);

/// Of `names` the one that was probably meant by `text`, "" if none is near.
std::string Nearest(std::string_view text, const std::vector<std::string>& names);

}  // namespace nscdd
