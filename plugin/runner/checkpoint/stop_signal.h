// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace nscdd {

/// While one lives, the first SIGTERM, SIGINT or SIGUSR1 is only noted, so that the program can end in order; from the second
/// on signals do what they did before. One at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// Number of the signal that came, 0 if none.
  int received() const;
};

}  // namespace nscdd
