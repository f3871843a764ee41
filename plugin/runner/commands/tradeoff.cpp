// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "checkpoint/stop_signal.h"
#include "nscdd/error.h"
#include "nscdd/normal_law.h"
#include "results/progress_bar.h"
#include "results/written_file.h"
#include "scene/platform.h"
#include "scene/read_scene.h"
#include "stopwatch.h"
#include "tradeoff/tradeoff_output.h"
#include "tradeoff/views.h"

namespace nscdd {
namespace {

/// How much is measured unless the user says so.
struct Extent {
  std::int64_t steps, problems;
  int repetitions;
  double seconds;
};
constexpr Extent kFull{100, 20, 5, 600.0}, kQuick{5, 3, 1, 60.0};
constexpr double kScoutShare = 0.2, kReferenceShare = 0.3;  // of the time limit at most

/// Options that say what problem a step is, not how it is solved.
constexpr const char* kSteppingKeys[] = {"theta",         "normal_law",   "feedback_beta",
                                         "feedback_slop", "feedback_cap", "alert_distance"};

bool IsStepping(const std::string& key) {
  return std::any_of(std::begin(kSteppingKeys), std::end(kSteppingKeys), [&](const char* known) { return key == known; });
}

class TradeoffCommand {
 public:
  explicit TradeoffCommand(const TradeoffRequest& request) : request_(request), extent_(request.quick ? kQuick : kFull) {}

  void Execute() {
    Prepare();
    MakeSettings();
    OpenFolder();
    const StopSignal interrupt;
    Scout(interrupt);
    Record(interrupt);
    if (interrupt.received() == 0) Measure(interrupt);
    Conclude(interrupt.received() != 0);
  }

 private:
  void Prepare();
  void ReadStepping();
  void MakeSettings();
  void OpenFolder();
  void Scout(const StopSignal& interrupt);
  void Record(const StopSignal& interrupt);
  void Measure(const StopSignal& interrupt);
  void Conclude(bool interrupted);
  void WriteFile(const std::string& name, const std::string& text) const;
  void StoreFront() const;
  ProgressBar::Style BarStyle() const { return ProgressBar::StyleFor(stdout, request_.quiet); }
  void Say(const std::string& line) const {
    if (!request_.quiet) fmt::print("{}\n", line);
  }

  const TradeoffRequest& request_;
  Stopwatch watch_;  // since before scouting and reference
  Extent extent_;
  Scene scene_;
  SolverRegistry registry_;
  SolverChoice choice_;
  Plan plan_;
  std::int64_t contacts_ = 0;  // of the first step
  Accuracy accuracy_ = Accuracy::kNat;
  std::vector<Setting> settings_;
  std::filesystem::path folder_;
  std::unique_ptr<Course> course_;
  ReferenceRun reference_;
  std::vector<TradeoffRow> rows_;
};

void TradeoffCommand::Prepare() {
  scene_ = ReadSceneFile(request_.scene);
  registry_.Add(FindPlugin(request_.solver.plugin));
  // A scene for solver "auto" has no setting of its own yet: its front is what is measured here.
  SolverRequest own = request_.solver;
  if (scene_.solver.name == "auto") own.solver = "nscd";
  choice_ = ChooseSolver(scene_, own, registry_);
  accuracy_ = ParseAccuracy(request_.accuracy);
  plan_.scene = &scene_;
  plan_.registry = &registry_;
  plan_.adapter = request_.adapter.empty() ? scene_.adapter : request_.adapter;
  plan_.cold = request_.cold;
  plan_.observable = ParseObservable(request_.observable);
  plan_.steps = request_.steps.value_or(std::min(scene_.time.steps, extent_.steps));
  plan_.problems = std::min(plan_.steps, request_.problems.value_or(extent_.problems));
  extent_.repetitions = request_.repetitions.value_or(extent_.repetitions);
  extent_.seconds = request_.time_limit.value_or(extent_.seconds);
  ReadStepping();
}

/// The options that all settings share, as numbers for reading problems and as texts for the solvers.
void TradeoffCommand::ReadStepping() {
  const auto platform = MakePlatform(plan_.adapter, scene_);
  ForEachBody(scene_, 0, 1, [&](const BodyDefinition& body) { platform->Add(body); });
  platform->SetGravity(GravityAt(scene_.gravity, 1, scene_.time.dt, scene_.clock()));
  SerialCommunicator serial;
  plan_.mean_radius = 10.0 * std::max(0.0, DefaultAlertDistance(ReadSortedBodies(&platform->adapter()), &serial));
  SteppingOptions& s = plan_.stepping = SteppingOf(choice_, registry_);
  // Settings are compared on the problems of one stage, of which a step has one.
  const bool has_two = HasTwoStages(s.normal_law);
  if (has_two) s.normal_law = NormalLaw::kGap;
  if (s.alert_distance < 0.0) s.alert_distance = 0.1 * plan_.mean_radius;
  for (const auto& option : choice_.options) {
    const bool is_replaced = option.first == "alert_distance" || (has_two && option.first == "normal_law");
    if (IsStepping(option.first) && !is_replaced) plan_.stepping_texts.push_back(option);
  }
  if (has_two) plan_.stepping_texts.emplace_back("normal_law", "gap");
  plan_.stepping_texts.emplace_back("alert_distance", fmt::format("{}", s.alert_distance));
  contacts_ = static_cast<std::int64_t>(ReadStepProblem(&platform->adapter(), s, scene_.time.dt).keys.size());
}

void TradeoffCommand::MakeSettings() {
  Setting own{kSceneSetting, choice_.name, {}};
  for (const auto& option : choice_.options) {
    if (!IsStepping(option.first)) own.options.push_back(option);
  }
  settings_ = {own};
  std::vector<Setting> list = request_.settings.empty() ? DefaultSettings() : ReadSettings(request_.settings, registry_);
  if (request_.quick && request_.settings.empty()) std::erase_if(list, [](const Setting& s) { return !s.quick; });
  settings_.insert(settings_.end(), list.begin(), list.end());
  for (const std::string& solver : request_.solvers) {
    if (solver != "box2d") RequireSolver(registry_, solver);
  }
  if (!request_.solvers.empty()) {
    std::erase_if(settings_, [&](const Setting& s) {
      return s.name != kSceneSetting &&
             std::find(request_.solvers.begin(), request_.solvers.end(), s.solver) == request_.solvers.end();
    });
  }
  std::vector<std::string> notices;
  settings_ = KnownSettings(std::move(settings_), registry_, &notices);
  const std::string why_not = WhyNotBox2d(scene_);
  if (!why_not.empty() && std::erase_if(settings_, [](const Setting& s) { return s.is_box2d(); }) > 0) {
    notices.push_back("left out Box2D's own solver: " + why_not);
  }
  for (const std::string& notice : notices) Say(notice);
}

void TradeoffCommand::OpenFolder() {
  folder_ = request_.out.empty() ? std::filesystem::path("results") / (scene_.name + "_tradeoff")
                                 : std::filesystem::path(request_.out);
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw Error(CannotWrite(folder_, error.value()));
}

void TradeoffCommand::Scout(const StopSignal& interrupt) {
  const std::int64_t all = scene_.time.steps;
  Say(fmt::format("{}: {} of {} steps of {} s on {}, {} settings", scene_.name, plan_.steps, all, scene_.time.dt, plan_.adapter,
                  settings_.size()));
  ProgressBar bar(stdout, BarStyle(), all);
  course_ = std::make_unique<Course>(
      plan_, kScoutShare * extent_.seconds, [&] { return interrupt.received() != 0; },
      [&](std::int64_t step) { bar.Update(fmt::format("scouting, step {}", step)); });
  bar.Finish();
}

void TradeoffCommand::Record(const StopSignal& interrupt) {
  const Setting setting = ReferenceSetting(registry_, contacts_);
  ProgressBar bar(stdout, BarStyle(), course_->steps());
  reference_ = RecordReference(
      plan_, setting, kReferenceShare * extent_.seconds, [&] { return interrupt.received() != 0; },
      [&](std::int64_t, double nat) { bar.Update(fmt::format("reference  nat {:.1e}", nat)); }, course_.get());
  bar.Finish();
  Say(
      fmt::format("reference: by {}, {} steps in {:.1f} s, nat median {:.1e}, largest {:.1e}; {} of them short of 1e-10; {} "
                  "problems recorded",
                  setting.name, reference_.nat.size(), reference_.seconds, Median(reference_.nat),
                  Percentile(reference_.nat, 1.0), reference_.not_converged, reference_.steps.size()));
  Say("measured: " + course_->Summary());
  if (course_->steps() < plan_.steps && interrupt.received() == 0) {
    Say(fmt::format("measured: the time limit leaves room for {} of {} steps; raise --time-limit, or ask for fewer --steps",
                    course_->steps(), plan_.steps));
  }
}

void TradeoffCommand::Measure(const StopSignal& interrupt) {
  std::vector<std::unique_ptr<View>> views;
  views.push_back(std::make_unique<ProblemsView>(plan_, reference_));
  views.push_back(std::make_unique<RunsView>(plan_, reference_, course_.get()));
  TradeoffCsv csv(folder_ / "tradeoff.csv");
  std::unique_ptr<ProgressBar> bar;
  MeasurementEvents events;
  events.measured = [&](const TradeoffRow& row) { csv.Append(row); };
  events.timed = [&](const std::vector<TradeoffRow>& rows) { csv.Rewrite(rows); };
  events.tick = [&](const std::string& note, bool failed) { bar->Update(note, failed); };
  events.interrupted = [&] { return interrupt.received() != 0; };
  Measurement measurement(settings_, std::move(views), extent_.repetitions, extent_.seconds - watch_.seconds(), events);
  bar = std::make_unique<ProgressBar>(stdout, BarStyle(), measurement.ticks());
  measurement.Run();
  bar->Finish();
  rows_ = measurement.rows();
}

void TradeoffCommand::WriteFile(const std::string& name, const std::string& text) const { ReplaceText(folder_ / name, text); }

/// Rows that `solver = "auto"` reads: runs of the plugin, one step a step, all of which did as asked, on the front of the
/// interpenetration.
void TradeoffCommand::StoreFront() const {
  std::vector<TradeoffRow> rows = OfView(rows_, "runs");
  std::erase_if(rows, [](const TradeoffRow& r) { return r.setting.substeps != 1 || !r.is_advisable(); });
  std::string text = TradeoffHeader();
  for (const std::size_t i : ParetoFront(rows, Accuracy::kInterpenetration)) text += TradeoffLine(rows[i]);
  WriteFile(scene_.name + ".front.csv", text);
  if (!request_.store) return;
  const std::filesystem::path beside = std::filesystem::path(scene_.file).replace_extension(".front.csv");
  ReplaceText(beside, text);
  Say(fmt::format("front for solver \"auto\": {}", beside.string()));
}

void TradeoffCommand::Conclude(bool interrupted) {
  if (rows_.empty()) return Say("interrupted before anything was measured");
  const std::vector<TradeoffRow> problems = OfView(rows_, "problems"), runs = OfView(rows_, "runs");
  const auto tables = [&](bool all) {
    return "\nThe same problems" + std::string(plan_.cold ? ", from zero impulses" : "") +
           ", time of the solve alone; * front of the velocity error\n" + FormatTable(problems, Accuracy::kVelocityError, all) +
           fmt::format("\nRuns, detection included; * front of {}\n", NameOf(accuracy_)) + FormatTable(runs, accuracy_, all);
  };
  Say(tables(false));
  const std::string box2d = FormatBox2dComparison(runs);
  const std::string advice =
      fmt::format("# rests on {}\n", course_->Summary()) + FormatAdvice(runs, {accuracy_, request_.budget}, plan_);
  if (!box2d.empty()) Say("Beside Box2D's own solver, runs\n" + box2d);
  Say("Settings to paste\n" + advice);
  WriteFile("tradeoff.txt", tables(true) + "\n" + box2d + "\n" + advice);
  StoreFront();
  Say("plot: " + PlotTradeoff(folder_, scene_.name, rows_));
  if (interrupted) Say("interrupted: what was measured until then is above and in the files");
  Say(fmt::format("results: {}", folder_.string()));
}

}  // namespace

void Tradeoff(const TradeoffRequest& request) { TradeoffCommand(request).Execute(); }

}  // namespace nscdd
