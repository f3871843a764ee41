// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace nscdd {

/// Bad input, or a platform that broke its contract: one sentence for the user that says what was wrong, where (key, id,
/// function) and how to mend it. Never thrown for non-convergence, which is a status (report.h).
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence) : std::runtime_error(sentence) {}
};

}  // namespace nscdd
