// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace nscdd {

/// What a user should hear about input that is legal and yet perhaps not what was meant: whole sentences, each said once.
struct Notes {
  std::vector<std::string> sentences;
};

}  // namespace nscdd
