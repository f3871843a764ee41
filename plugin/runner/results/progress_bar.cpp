// SPDX-License-Identifier: Apache-2.0
#include "results/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>

#include "stopwatch.h"

namespace nscdd {
namespace {

constexpr double kRedrawSeconds = 0.1;
constexpr double kLineSeconds = 30.0;

std::string FormatDuration(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{:02}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

/// Columns of the terminal; 0 if it is none. mpirun puts a terminal without columns before its ranks where its own output is
/// a file or a pipe.
std::size_t TerminalWidth(std::FILE* stream) {
  winsize size{};
  return ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

ProgressBar::Style ProgressBar::StyleFor(std::FILE* stream, bool quiet) {
  if (quiet) return Style::kNone;
  return TerminalWidth(stream) > 0 ? Style::kBar : Style::kLines;
}

ProgressBar::ProgressBar(std::FILE* stream, Style style, std::int64_t steps, Clock clock, std::int64_t done)
    : stream_(stream),
      style_(style),
      steps_(std::max<std::int64_t>(1, steps)),
      clock_(clock ? std::move(clock) : Clock(SteadySeconds)),
      begin_(clock_()),
      last_output_(begin_),
      done_before_(done),
      done_(done),
      done_at_last_output_(done) {}

ProgressBar::~ProgressBar() { Finish(); }

bool ProgressBar::IsDue(double now) const {
  if (done_ == steps_) return true;
  if (style_ == Style::kBar) return !line_open_ || now - last_output_ >= kRedrawSeconds;
  return done_ * 10 / steps_ > done_at_last_output_ * 10 / steps_ || now - last_output_ >= kLineSeconds;
}

std::string ProgressBar::Line(const std::string& note, double now) const {
  const double remaining = (now - begin_) / static_cast<double>(done_ - done_before_) * static_cast<double>(steps_ - done_);
  std::string line = fmt::format("{:3} %  step {}/{}  {}", done_ * 100 / steps_, done_, steps_, note);
  if (not_converged_ > 0) line += fmt::format("  {} not converged", not_converged_);
  return line + (done_ < steps_ ? fmt::format("  {} left", FormatDuration(remaining))
                                : fmt::format("  {} taken", FormatDuration(now - begin_)));
}

void ProgressBar::Update(const StepReport& step) {
  Update(fmt::format("{} iterations  nat {:.1e}", step.solve.iterations, step.solve.residuals.nat),
         !IsAsAsked(step.solve.status));
}

void ProgressBar::Update(const std::string& note, bool failed) {
  if (style_ == Style::kNone) return;
  ++done_;
  if (failed) ++not_converged_;
  const double now = clock_();
  if (!IsDue(now)) return;

  std::string line = Line(note, now);
  if (style_ == Style::kLines) {
    fmt::print(stream_, "{}\n", line);
  } else {
    const std::size_t columns = TerminalWidth(stream_);
    const std::size_t width = (columns > 0 ? columns : 80) - 1;
    const std::size_t room = std::min<std::size_t>(40, width > line.size() + 3 ? width - line.size() - 3 : 0);
    const std::size_t filled = room * static_cast<std::size_t>(done_) / static_cast<std::size_t>(steps_);
    if (room > 0) line = fmt::format("[{:#>{}}{:.>{}}] {}", "", filled, "", room - filled, line);
    fmt::print(stream_, "\r{}\x1b[K", line.substr(0, width));  // ESC [ K: erases what the last one had more
    line_open_ = true;
  }
  std::fflush(stream_);
  last_output_ = now;
  done_at_last_output_ = done_;
}

void ProgressBar::Finish() {
  if (!line_open_) return;
  fmt::print(stream_, "\n");
  std::fflush(stream_);
  line_open_ = false;
}

}  // namespace nscdd
