// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

#include "nscdd/report.h"

namespace nscdd {

/// Tells the user how far the run is. Use it on rank 0 only.
class ProgressBar {
 public:
  enum class Style {
    kBar,    ///< one line of a terminal, redrawn
    kLines,  ///< a plain line every tenth of the run, and at least every 30 s
    kNone,
  };
  using Clock = std::function<double()>;  ///< [s] since any moment

  /// kNone if `quiet`, else kBar if `stream` is a terminal that has columns.
  static Style StyleFor(std::FILE* stream, bool quiet);

  /// `clock` is for tests; by default the steady clock. `done` steps out of `steps` were taken before.
  ProgressBar(std::FILE* stream, Style style, std::int64_t steps, Clock clock = {}, std::int64_t done = 0);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// After each step.
  void Update(const StepReport& step);
  /// The same for work that is no step of a run; `note` is what the line says of it.
  void Update(const std::string& note, bool failed = false);
  /// Ends the line of a bar, so that other output begins on a new one. Also done by the destructor.
  void Finish();

 private:
  std::string Line(const std::string& note, double now) const;
  bool IsDue(double now) const;

  std::FILE* stream_;
  Style style_;
  std::int64_t steps_;
  Clock clock_;
  double begin_;
  double last_output_;
  std::int64_t done_before_;
  std::int64_t done_;
  std::int64_t done_at_last_output_;
  std::int64_t not_converged_ = 0;
  bool line_open_ = false;
};

}  // namespace nscdd
