// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "nscdd/communicator.h"

namespace nscdd {

/// Seconds of the parts of a step, those spent in communication apart.
class StepClock {
 public:
  explicit StepClock(const Communicator& communicator)
      : communicator_(communicator), before_(communicator.counters()), waited_(before_.seconds) {}

  /// Since the last lap, communication excluded [s].
  double Lap() {
    const Clock::time_point now = Clock::now();
    const double waited = communicator_.counters().seconds;
    const double lap = Seconds(lap_, now) - (waited - waited_);
    lap_ = now;
    waited_ = waited;
    return lap;
  }
  double Total() const { return Seconds(start_, Clock::now()); }

  /// Of the communicator, since the clock was made.
  CommunicationCounters Communication() const {
    const CommunicationCounters& now = communicator_.counters();
    return {now.messages - before_.messages, now.bytes - before_.bytes, now.collectives - before_.collectives,
            now.seconds - before_.seconds};
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double Seconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }

  const Communicator& communicator_;
  CommunicationCounters before_;
  double waited_;
  Clock::time_point start_ = Clock::now(), lap_ = start_;
};

}  // namespace nscdd
