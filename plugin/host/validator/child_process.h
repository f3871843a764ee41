// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace nscdd {

/// How a function ended in a child process: `sentence` is empty if it returned.
struct ChildOutcome {
  std::string sentence;
};

/// Calls `function` in a child process whose output goes nowhere. An exception, a crash, an exit and a run of more than
/// `seconds` (the child is killed then) become a sentence.
ChildOutcome RunInChild(const std::function<void()>& function, double seconds);

}  // namespace nscdd
