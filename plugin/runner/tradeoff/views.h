// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/platform.h"
#include "stopwatch.h"
#include "tradeoff/course.h"
#include "tradeoff/tradeoff_row.h"

namespace nscdd {

/// A way to look at settings: what they do to the scene, and how long it takes.
class View {
 public:
  virtual ~View() = default;
  virtual const char* name() const = 0;
  /// Whether the setting says anything here.
  virtual bool Takes(const Setting& setting) const = 0;
  /// Steps through once, measuring and timing. A failure of the solver becomes a row that says so.
  virtual TradeoffRow Measure(const Setting& setting, Timings* timings, const StopQuestion& stop) = 0;
  /// Steps through once more for the time alone; leaves no trace when stopped.
  virtual void Time(const Setting& setting, Timings* timings, const StopQuestion& stop) = 0;
};

/// Each setting solves the recorded problems, from the impulses of the reference's step before (or from zero). Timed: the solve
/// alone (building its arrays included). Box2D is not here: it has no contact while a gap is positive, and an accurate run
/// leaves half of them so, by rounding.
class ProblemsView final : public View {
 public:
  ProblemsView(const Plan& plan, const ReferenceRun& reference);
  const char* name() const override { return "problems"; }
  bool Takes(const Setting& setting) const override { return setting.substeps == 1 && !setting.is_box2d(); }
  TradeoffRow Measure(const Setting& setting, Timings* timings, const StopQuestion& stop) override;
  void Time(const Setting& setting, Timings* timings, const StopQuestion& stop) override;

 private:
  const Plan& plan_;
  const ReferenceRun& reference_;
  std::unique_ptr<Platform> geometry_;  ///< the scene's bodies: finds the contacts at any poses
};

/// Each setting runs the stretches of the course, each on its own trajectory from the same start. Timed: whole steps, detection
/// included, CPU time of the process.
class RunsView final : public View {
 public:
  RunsView(const Plan& plan, const ReferenceRun& reference, Course* course)
      : plan_(plan), reference_(reference), course_(*course) {}
  const char* name() const override { return "runs"; }
  bool Takes(const Setting&) const override { return true; }
  TradeoffRow Measure(const Setting& setting, Timings* timings, const StopQuestion& stop) override;
  void Time(const Setting& setting, Timings* timings, const StopQuestion& stop) override;

 private:
  /// `make` for every step of the course, in order, with a contestant that stands before it; false: `stop` ended it.
  bool ForEachStep(const Setting& setting, bool keep_impulses, const StopQuestion& stop,
                   const std::function<void(Contestant* contestant)>& make);
  double MeasureStep(double reference, Contestant* contestant, const Setting& setting, RowBuilder* row) const;

  const Plan& plan_;
  const ReferenceRun& reference_;
  Course& course_;
};

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
  Stopwatch watch_;
  MeasurementEvents events_;
  std::vector<Pair> pairs_;
  std::vector<TradeoffRow> rows_;
};

}  // namespace nscdd
