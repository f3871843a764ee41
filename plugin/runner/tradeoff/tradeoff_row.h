// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nscdd/answer_measures.h"
#include "nscdd/interpenetration.h"
#include "tradeoff/contestant.h"
#include "tradeoff/plan.h"

namespace nscdd {

/// A setting as measured in one view. Lengths in mean radii of the free bodies; README.md defines every number.
struct TradeoffRow {
  std::string view;  ///< "problems" or "runs"
  Setting setting;
  std::string status;      ///< of the worst step: NameOf(SolveStatus), "failed" or, when it took too long for the whole, "cut"
  std::string reason;      ///< one clause, of the worst step
  std::int64_t steps = 0;  ///< measured
  std::int64_t not_converged = 0;  ///< of them: iteration limit, stalled or diverged
  double nat = 0.0;                ///< [-] median over the steps
  double nat_worst = 0.0;          ///< largest
  double nat_max = 0.0;            ///< [-] median
  double nat_max_worst = 0.0;
  double velocity_error = -1.0;  ///< [-] median; < 0: not measured in this view
  double velocity_error_worst = -1.0;
  double worst_body = -1.0;            ///< [-] largest
  double interpenetration_mean = 0.0;  ///< mean over the steps
  double interpenetration_p99 = 0.0;   ///< mean over the steps
  double interpenetration_max = 0.0;   ///< largest
  InterpenetrationGrowth growth;       ///< per step of the scene: means of means, largest of largest
  double momentum_defect = 0.0;        ///< [-] median
  double energy_defect = 0.0;          ///< [-] mean, signed
  double observable = 0.0;             ///< mean over the steps
  double observable_error = 0.0;       ///< largest difference from the reference
  double seconds = 0.0;                ///< a step: per step the median over the repetitions, then the mean over the steps
  double seconds_least = 0.0;          ///< mean of the fastest repetition
  double seconds_most = 0.0;
  std::int64_t repetitions = 0;
  double sweeps = 0.0;          ///< a step
  double exchanges = 0.0;       ///< a step
  double exchange_bytes = 0.0;  ///< a step

  /// Whether its numbers mean something: it ran to the end and did not diverge.
  bool is_sound() const { return status != "failed" && status != "cut" && status != "diverged"; }
  /// Whether to propose it: a solver of the plugin that did in every step what it was asked for.
  bool is_advisable() const { return is_sound() && not_converged == 0 && !setting.is_box2d(); }
};

double Median(std::vector<double> values);

/// Seconds of every step in every repetition.
class Timings {
 public:
  void Begin() { runs_.emplace_back(); }
  void Add(double seconds) { runs_.back().push_back(seconds); }
  /// Forgets the repetition that Begin() started last, of which a step is missing.
  void DropLast() { runs_.pop_back(); }
  /// Forgets the first repetition (the one that also measured) if there are others.
  void Fill(TradeoffRow* row) const;
  double LastTotal() const;

 private:
  std::vector<std::vector<double>> runs_;
};

/// Everything that a step's end says, lengths in metres.
struct StepMeasurement {
  AnswerResiduals residuals;
  VelocityError velocity_error{-1.0, -1.0};
  InterpenetrationGrowth growth;
  Effort effort;
};

/// Gathers steps into a row.
class RowBuilder {
 public:
  RowBuilder(std::string view, const Setting& setting, double mean_radius);
  /// One solve: a step of the scene or one of its substeps.
  void AddSolve(const StepMeasurement& m);
  /// The end of a step of the scene. `reference`: the observable there.
  void AddStep(const Interpenetration& i, double observable, double reference);
  /// Row of what was added; `cut`: the rest was left out; `failure`: sentence that ended it.
  TradeoffRow Build(bool cut, const std::string& failure) const;

 private:
  TradeoffRow row_;
  double radius_;
  SolveStatus worst_ = SolveStatus::kConverged;
  double solves_ = 0.0;
  std::vector<double> nat_, nat_max_, velocity_error_, momentum_;
};

/// What "accurate" means when settings are ranked; smaller is better.
enum class Accuracy { kNat, kNatMax, kVelocityError, kInterpenetration };

Accuracy ParseAccuracy(const std::string& name);  ///< Throws Error with the names that exist
std::string NameOf(Accuracy accuracy);
/// Number of the row; < 0: not measured in its view.
double ErrorOf(const TradeoffRow& row, Accuracy accuracy);

/// Rows that no other row beats: ascending in seconds, strictly falling in error. Unsound rows and those that did not measure
/// the error are left out. Indices into `rows`.
std::vector<std::size_t> ParetoFront(const std::vector<TradeoffRow>& rows, Accuracy accuracy);

/// The cheapest row whose error is at most 10^-k, for every k between the largest and the smallest error of the front.
struct DecadeChoice {
  int decade = 0;  ///< k
  std::size_t row = 0;
};
std::vector<DecadeChoice> CheapestByDecade(const std::vector<TradeoffRow>& rows, Accuracy accuracy);

/// The most accurate row that takes at most `seconds` a step.
std::optional<std::size_t> BestWithin(const std::vector<TradeoffRow>& rows, Accuracy accuracy, double seconds);

/// The cheapest sound row of the plugin that is at least as accurate as `other` in nat and in the largest interpenetration.
std::optional<std::size_t> CheapestAsGood(const std::vector<TradeoffRow>& rows, const TradeoffRow& other);

}  // namespace nscdd
