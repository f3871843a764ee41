// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/views.h"

#include <fmt/format.h>

#include <algorithm>

namespace nscdd {

Measurement::Measurement(std::vector<Setting> settings, std::vector<std::unique_ptr<View>> views, int repetitions,
                         double seconds, MeasurementEvents events)
    : settings_(std::move(settings)),
      views_(std::move(views)),
      repetitions_(repetitions),
      seconds_(seconds),
      events_(std::move(events)) {
  for (const Setting& setting : settings_) {
    for (const auto& view : views_) {
      if (view->Takes(setting)) pairs_.push_back({&setting, view.get(), {}});
    }
  }
  share_ = seconds / static_cast<double>(std::max<std::size_t>(1, pairs_.size()));
}

std::int64_t Measurement::ticks() const { return static_cast<std::int64_t>(pairs_.size()) * (1 + repetitions_); }

double Measurement::Allowance() const { return std::max(0.5 * share_, (seconds_ - watch_.seconds()) / 8.0); }

void Measurement::MeasurePair(Pair* pair) {
  const Stopwatch watch;
  const double allowance = Allowance();
  const auto stop = [&] { return events_.interrupted() || watch.seconds() > allowance; };
  TradeoffRow row = pair->view->Measure(*pair->setting, &pair->timings, stop);
  pair->timings.Fill(&row);
  pair->row = rows_.size();
  pair->done = row.status == "cut" || row.status == "failed";
  rows_.push_back(row);
  events_.measured(row);
  events_.tick(fmt::format("{}: {}", row.view, row.setting.name), !row.is_sound());
}

void Measurement::TimePair(Pair* pair) {
  pair->done = pair->done || pair->timings.LastTotal() > Allowance();
  if (!pair->done) {
    pair->view->Time(*pair->setting, &pair->timings, events_.interrupted);
    pair->timings.Fill(&rows_[pair->row]);
  }
  events_.tick(fmt::format("{}: {}", rows_[pair->row].view, rows_[pair->row].setting.name), false);
}

void Measurement::Run() {
  watch_ = {};
  for (Pair& pair : pairs_) {
    if (events_.interrupted()) return;
    MeasurePair(&pair);
  }
  for (int pass = 0; pass < repetitions_; ++pass) {
    for (Pair& pair : pairs_) {
      if (events_.interrupted()) break;
      TimePair(&pair);
    }
    events_.timed(rows_);
    if (events_.interrupted()) return;
  }
}

}  // namespace nscdd
