// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nscdd/error.h"

namespace nscdd {

/// `function` must throw Error with a sentence that has all of `parts`.
template <class Function>
void ExpectError(Function&& function, const std::vector<std::string>& parts) {
  try {
    function();
  } catch (const Error& e) {
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << "'" << part << "' is not in: " << e.what();
    }
    return;
  }
  ADD_FAILURE() << "no Error was thrown; expected one with '" << (parts.empty() ? "" : parts[0]) << "'";
}

}  // namespace nscdd
