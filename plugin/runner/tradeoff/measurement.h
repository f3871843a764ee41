// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tradeoff/views.h"

namespace nscdd {

/// What a measurement tells while it goes on.
struct MeasurementEvents {
  std::function<void(const TradeoffRow&)> measured;                ///< a new row, its seconds those of the measuring pass
  std::function<void(const std::vector<TradeoffRow>&)> timed;      ///< all rows with the seconds after one more pass
  std::function<void(const std::string& note, bool failed)> tick;  ///< a setting is done in a view, in one pass
  std::function<bool()> interrupted;                               ///< asked between steps
};

/// Measures settings in views: one pass that measures accuracy, then interleaved passes that only time.
class Measurement {
 public:
  /// `seconds`: what all passes together may take, about. A setting in a view gets an eighth of what is left of it, and half of
  /// an equal share at least: beyond that its measuring pass is cut, and passes for the time are left out.
  Measurement(std::vector<Setting> settings, std::vector<std::unique_ptr<View>> views, int repetitions, double seconds,
              MeasurementEvents events);

  /// Calls of tick() if nothing is interrupted.
  std::int64_t ticks() const;
  void Run();
  const std::vector<TradeoffRow>& rows() const { return rows_; }

 private:
  /// A setting in a view.
  struct Pair {
    const Setting* setting;
    View* view;
    Timings timings;
    std::size_t row = 0;
    bool done = false;  // not worth another pass
  };
  void MeasurePair(Pair* pair);
  void TimePair(Pair* pair);
  double Allowance() const;

  std::vector<Setting> settings_;
  std::vector<std::unique_ptr<View>> views_;
  int repetitions_;
  double seconds_;      // [s]
  double share_ = 0.0;  // [s] of a pair
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  MeasurementEvents events_;
  std::vector<Pair> pairs_;
  std::vector<TradeoffRow> rows_;
};

}  // namespace nscdd
