// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace nscdd {

/// What is checked, for how long, and where the results go.
struct ValidatorOptions {
  double seconds_per_check = 20.0;                     ///< a check that takes longer has failed
  std::string only;                                    ///< if not empty: run only the checks whose name contains it
  std::function<void(const std::string& line)> print;  ///< one line per check: "ok      name" or "FAILED  name: sentence"
};

/// Runs every check on the plugin `path`, each in a child process, so that a crash or a hang is a failed check and no more.
/// Call it from a process with one thread. Returns the number of failed checks; 0: a valid plugin. Throws
/// Error when no check has `only` in its name.
int ValidatePlugin(const std::string& path, const ValidatorOptions& options);

}  // namespace nscdd
