// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "nscdd/natural_residual.h"

namespace nscdd {
namespace {

double Sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double Worst(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0, Larger); }

/// Numbers that are none would vanish in a sorted list: they count as infinite.
double MedianOf(std::vector<double> values) {
  for (double& x : values) x = std::isnan(x) ? HUGE_VAL : x;
  return Median(std::move(values));
}

/// From what was asked for to what is of no use.
int Badness(SolveStatus status) {
  constexpr std::array kOrder = {SolveStatus::kConverged,      SolveStatus::kFixed,   SolveStatus::kIncomplete,
                                 SolveStatus::kIterationLimit, SolveStatus::kStalled, SolveStatus::kDiverged};
  return static_cast<int>(std::find(kOrder.begin(), kOrder.end(), status) - kOrder.begin());
}

}  // namespace

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

void Timings::Fill(TradeoffRow* row) const {
  const std::size_t first = runs_.size() > 1 ? 1 : 0;
  if (runs_.size() == first || runs_[first].empty()) return;
  const std::size_t steps = runs_[first].size();
  const auto count = static_cast<double>(steps);
  row->repetitions = static_cast<std::int64_t>(runs_.size() - first);
  row->seconds = 0.0;
  for (std::size_t k = 0; k < steps; ++k) {
    std::vector<double> same;
    for (std::size_t r = first; r < runs_.size(); ++r) same.push_back(runs_[r].at(k));
    row->seconds += Median(std::move(same)) / count;
  }
  std::vector<double> means;
  for (std::size_t r = first; r < runs_.size(); ++r) means.push_back(Sum(runs_[r]) / count);
  row->seconds_least = *std::min_element(means.begin(), means.end());
  row->seconds_most = *std::max_element(means.begin(), means.end());
}

double Timings::LastTotal() const { return runs_.empty() ? 0.0 : Sum(runs_.back()); }

RowBuilder::RowBuilder(std::string view, const Setting& setting, double mean_radius)
    : radius_(mean_radius > 0.0 ? mean_radius : 1.0) {
  row_.view = std::move(view);
  row_.setting = setting;
}

void RowBuilder::AddSolve(const StepMeasurement& m) {
  solves_ += 1.0;
  nat_.push_back(m.residuals.nat);
  nat_max_.push_back(m.residuals.nat_max);
  momentum_.push_back(m.residuals.momentum_defect);
  row_.energy_defect += m.residuals.energy_defect;
  if (!(m.velocity_error.energy_norm < 0.0)) {
    velocity_error_.push_back(m.velocity_error.energy_norm);
    row_.worst_body = Worst({row_.worst_body, m.velocity_error.worst_body});
  }
  row_.growth.solver_mean += m.growth.solver_mean / radius_;
  row_.growth.geometry_mean += m.growth.geometry_mean / radius_;
  row_.growth.solver_max = std::max(row_.growth.solver_max, m.growth.solver_max / radius_);
  row_.growth.geometry_max = std::max(row_.growth.geometry_max, m.growth.geometry_max / radius_);
  row_.sweeps += static_cast<double>(m.effort.sweeps);
  row_.exchanges += static_cast<double>(m.effort.exchanges);
  row_.exchange_bytes += static_cast<double>(m.effort.exchange_bytes);
  if (!IsAsAsked(m.effort.status)) ++row_.not_converged;
  if (solves_ > 1.0 && Badness(m.effort.status) <= Badness(worst_)) return;
  worst_ = m.effort.status;
  row_.reason = m.effort.reason;
}

void RowBuilder::AddStep(const Interpenetration& i, double observable, double reference) {
  ++row_.steps;
  row_.interpenetration_mean += i.mean / radius_;
  row_.interpenetration_p99 += i.p99 / radius_;
  row_.interpenetration_max = Worst({row_.interpenetration_max, i.max / radius_});
  row_.observable += observable;
  row_.observable_error = Worst({row_.observable_error, std::abs(observable - reference)});
}

TradeoffRow RowBuilder::Build(bool cut, const std::string& failure) const {
  TradeoffRow row = row_;
  const double steps = std::max(1.0, static_cast<double>(row.steps));
  for (double* sum : {&row.interpenetration_mean, &row.interpenetration_p99, &row.observable, &row.sweeps, &row.exchanges,
                      &row.exchange_bytes, &row.growth.solver_mean, &row.growth.geometry_mean}) {
    *sum /= steps;
  }
  row.energy_defect /= std::max(1.0, solves_);
  row.nat = MedianOf(nat_);
  row.nat_worst = Worst(nat_);
  row.nat_max = MedianOf(nat_max_);
  row.nat_max_worst = Worst(nat_max_);
  row.momentum_defect = MedianOf(momentum_);
  if (!velocity_error_.empty()) {
    row.velocity_error = MedianOf(velocity_error_);
    row.velocity_error_worst = Worst(velocity_error_);
  }
  row.status = !failure.empty() ? "failed" : cut ? "cut" : NameOf(worst_);
  if (!failure.empty()) row.reason = failure;
  return row;
}

}  // namespace nscdd
