// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "checkpoint/resume_point.h"
#include "commands/print_notes.h"
#include "commands/run_plan.h"
#include "commands/run_state.h"
#include "nscdd/error.h"
#include "nscdd/host/adapter_host.h"
#include "results/final_csv.h"
#include "results/progress_bar.h"
#include "results/results_file.h"
#include "results/results_folder.h"
#include "results/run_summary.h"
#include "results/steps_csv.h"
#include "run_results.h"
#include "scene/body_stream.h"
#include "scene/disk_file.h"
#include "scene/platform.h"
#include "scene/read_scene.h"
#include "stopwatch.h"

namespace nscdd {
namespace {

constexpr int kInterruptedCode = 4;

/// A run in the making; members in the order in which they come to be.
class SceneRun {
 public:
  SceneRun(const RunRequest& request, const MpiSession& session)
      : request_(request), ranks_(session.ranks()), session_(session) {}

  int Execute() {
    if (!request_.resume.empty()) {
      OpenEarlier();
    } else {
      ranks_.RunTogether([&] { plan_ = PlanRun(request_, ranks_.size()); });
    }
    ranks_.RunOnRoot([&] { NoteOddities(&plan_.scene); });
    if (ranks_.is_root() && !request_.quiet) PrintNotes(plan_.scene.notes);
    ranks_.RunTogether([&] {
      platform_ = MakePlatform(plan_.record.adapter, plan_.scene);
      AddBodies();
    });
    host_ = std::make_unique<AdapterHost>(&platform_->adapter());
    solver_ = std::make_unique<Solver>(
        plan_.registry.Create({plan_.choice.name, plan_.choice.options, host_->table(), session_.solver_communicator()}));
    OpenResults();
    Begin();
    const Ending ending = StepsOrHint();
    if (ending == Ending::kInterrupted) return SayHowToResume();
    if (ending == Ending::kNotConverged) folder_->Count("stopped_at_step", summary_.last.step);
    CloseResults();
    PrintSummary(ending == Ending::kNotConverged);
    return ending == Ending::kNotConverged ? 3 : 0;
  }

 private:
  enum class Ending { kFinished, kNotConverged, kInterrupted };

  void OpenEarlier();
  void AddBodies();
  void OpenResults();
  void Begin();
  void WarmStart();
  void Note(const std::string& sentence);
  Ending StepsOrHint();
  Ending Steps();
  void SaveInitialState();
  void Save(const StepReport& report);
  void NoteDeepOverlaps(double mean_radius);
  void CloseResults();
  void PrintSummary(bool stopped);
  int SayHowToResume();
  std::int64_t before() const { return plan_.scene.clock().step; }
  std::int64_t done() const { return resume_ ? resume_->head().step : before(); }
  /// Whether its bodies and contacts are saved however long the run is.
  bool IsSaved(std::int64_t step) const {
    return step == before() + 1 || (plan_.record.save_every > 0 && step % plan_.record.save_every == 0);
  }

  const RunRequest& request_;
  const RankGroup& ranks_;
  const MpiSession& session_;
  Stopwatch watch_;
  RunPlan plan_;
  std::unique_ptr<ResultsFolder> folder_;
  std::unique_ptr<ResumePoint> resume_;  // null unless an earlier run goes on
  std::unique_ptr<Platform> platform_;
  std::int64_t bodies_ = 0;  // of this rank's platform
  ShapeTable shapes_;
  std::unique_ptr<AdapterHost> host_;
  std::unique_ptr<Solver> solver_;
  std::unique_ptr<StepsCsv> csv_;
  std::unique_ptr<ResultsFile> file_;
  std::unique_ptr<RunCheckpoints> checkpoints_;  // null if there are none
  RunSummary summary_;
  double seconds_before_ = 0.0;  // [s] that the steps before --resume took
  RunClock clock_;               // after the last step
  std::string overlap_note_;
};

void SceneRun::OpenEarlier() {
  ranks_.RunTogether([&] { RefuseConflicts(request_); });
  folder_ = std::make_unique<ResultsFolder>(request_.resume, ranks_);
  resume_ = std::make_unique<ResumePoint>(request_.resume, ranks_, folder_->has_finished());
  for (const std::string& warning : resume_->warnings()) {
    fmt::print(stderr, "nscdd: WARNING: {} Going on from the checkpoint after step {} instead.\n", warning, done());
  }
  ranks_.RunTogether([&] { plan_ = PlanResumedRun(request_, resume_->head()); });
  ranks_.RunOnRoot([&] { CheckInputs(plan_.record.inputs); });
  if (folder_->has_finished()) resume_->CopyResults(folder_.get(), !IsSaved(done()));
}

void SceneRun::AddBodies() {
  ForEachBody(plan_.scene, ranks_.rank(), ranks_.size(), [&](const BodyDefinition& body) {
    platform_->Add(body);
    AddShapes(body, &shapes_);
    ++bodies_;
  });
}

void SceneRun::OpenResults() {
  RunDescription run;
  run.scene = plan_.scene.name;
  run.solver = plan_.choice.name;
  run.version = NSCDD_VERSION;
  run.dt = plan_.scene.time.dt;
  run.subdomains_x = plan_.subdomains_x;
  run.subdomains_y = plan_.subdomains_y;
  if (plan_.scene.periodic) {
    run.period = plan_.scene.periodic->length;
    run.period_origin = plan_.scene.periodic->origin;
  }
  if (resume_) {
    folder_->Identify(IdentityOf(plan_, ranks_.size()));
    ranks_.RunOnRoot(
        [&] { ForEachStep(folder_->path(), resume_->head().tables, [&](const StepReport& step) { summary_.Add(step); }); });
    seconds_before_ = summary_.sum.seconds_total;
    csv_ = std::make_unique<StepsCsv>(folder_.get(), resume_->head().tables);
    file_ = std::make_unique<ResultsFile>(folder_.get(), run, shapes_, resume_->head().segments);
  } else {
    std::filesystem::path out = request_.out;
    if (out.empty()) out = plan_.scene.output.dir;
    if (out.empty()) out = std::filesystem::path("results") / plan_.scene.name;
    ranks_.RunOnRoot([&] { CheckStartStays(plan_.scene, out); });
    folder_ = std::make_unique<ResultsFolder>(out, IdentityOf(plan_, ranks_.size()), ranks_);
    csv_ = std::make_unique<StepsCsv>(folder_.get());
    file_ = std::make_unique<ResultsFile>(
        folder_.get(), run, shapes_,
        plan_.record.checkpoint_every > 0 ? ResultsFile::Mode::kSegments : ResultsFile::Mode::kWhole);
    SaveInitialState();
  }
  summary_.scene = plan_.scene.name;
  summary_.adapter = plan_.record.adapter;
  summary_.solver = plan_.pilot ? "auto" : plan_.choice.name;
  const std::string tolerance = OptionValue(plan_.choice, plan_.registry, "tolerance");
  summary_.criterion = fmt::format("{} <= {}", OptionValue(plan_.choice, plan_.registry, "criterion"), tolerance);
  if (OptionNumber(plan_.choice, plan_.registry, "tolerance") == 0.0)
    summary_.criterion = fmt::format("none: {} iterations", OptionValue(plan_.choice, plan_.registry, "max_iterations"));
  if (plan_.pilot) summary_.criterion = "of the rung in use";
  summary_.output = folder_->path().string();
  summary_.ranks = ranks_.size();
  summary_.subdomains_x = plan_.subdomains_x;
  summary_.subdomains_y = plan_.subdomains_y;
  summary_.steps_asked = plan_.record.steps - before();
}

/// The state before the first step, and a checkpoint of it.
void SceneRun::Begin() {
  clock_ = plan_.scene.clock();
  for (; clock_.step < done(); ++clock_.step) clock_.time += plan_.scene.time.dt;
  if (plan_.record.checkpoint_every > 0) {
    checkpoints_ =
        std::make_unique<RunCheckpoints>(plan_, folder_.get(), csv_.get(), file_.get(), platform_.get(), solver_.get());
  }
  if (done() > before()) {
    Restore(resume_->checkpoint(), bodies_, ranks_, platform_.get(), solver_.get());
  } else if (plan_.scene.start) {
    WarmStart();
  }
  if (!resume_) {
    ranks_.RunOnRoot([&] { plan_.record.inputs = InputsOf(plan_.scene); });
    if (checkpoints_) checkpoints_->Write(done());
    return;
  }
  if (checkpoints_) checkpoints_->set_last_step(done());
  if (ranks_.is_root() && !request_.quiet) fmt::print("going on after step {} of {}\n", done(), plan_.record.steps);
}

void SceneRun::WarmStart() {
  const std::string obstacle = LoadSolverState(plan_, ranks_, solver_.get());
  if (obstacle.empty() || resume_) return;  // whoever began the run was told
  plan_.record.notes.push_back(fmt::format("The first step begins from zero impulses, those in {} cannot be used: {}.",
                                           plan_.scene.start->path.string(), obstacle));
  Note(plan_.record.notes.back());
}

void SceneRun::Note(const std::string& sentence) {
  folder_->Note(sentence);
  if (ranks_.is_root() && !request_.quiet) PrintNotes({{sentence}});
}

/// An error on the way does not end the run for good.
SceneRun::Ending SceneRun::StepsOrHint() {
  try {
    return Steps();
  } catch (const Error& e) {
    if (!checkpoints_ || summary_.steps == 0) throw;
    throw Error(fmt::format("{} (Once that is mended, '{}' goes on after step {}.)", e.what(), checkpoints_->command(),
                            checkpoints_->last_step()));
  }
}

SceneRun::Ending SceneRun::Steps() {
  const std::int64_t last = plan_.record.steps;
  const double dt = plan_.scene.time.dt;
  ProgressBar bar(stdout, ranks_.is_root() ? ProgressBar::StyleFor(stdout, request_.quiet) : ProgressBar::Style::kNone, last,
                  {}, done());
  for (std::int64_t step = done() + 1; step <= last; ++step) {
    if (checkpoints_ && checkpoints_->IsToldToEnd(step - 1)) return Ending::kInterrupted;
    platform_->SetGravity(GravityAt(plan_.scene.gravity, step - before(), dt, plan_.scene.clock()));
    solver_->Step(dt);
    // The solver's own count goes back to the state that it was given, if any.
    StepReport report = solver_->Report();
    clock_.step = report.step = step;
    clock_.time = report.time = clock_.time + dt;
    folder_->KeepParts();
    csv_->Append(report);
    summary_.Add(report);
    bar.Update(report);
    const bool stop = !IsAsAsked(report.solve.status) && plan_.scene.solver.on_nonconvergence == OnNonconvergence::kStop;
    if (step == before() + 1) NoteDeepOverlaps(report.mean_radius);
    if (IsSaved(step) || step == last || stop) Save(report);
    if (stop) return Ending::kNotConverged;
    if (plan_.pilot) {
      report.step = step - before();
      plan_.pilot->AfterStep(report, dt, step < last, ranks_, session_, *host_, &platform_->adapter(), solver_.get());
    }
    if (checkpoints_) checkpoints_->WriteIfDue(step);
  }
  return Ending::kFinished;
}

void SceneRun::SaveInitialState() {
  GrainTable grains;
  ranks_.RunTogether([&] { grains = MakeGrainTable(&platform_->adapter()); });
  const RunClock start = plan_.scene.clock();
  file_->Save({start.step, start.TimeOf(start.step, plan_.scene.time.dt), MeanRadius(grains, ranks_)}, grains, {});
}

void SceneRun::Save(const StepReport& report) {
  const double dt = plan_.scene.time.dt;
  file_->Save({report.step, plan_.scene.clock().TimeOf(report.step, dt), report.mean_radius}, MakeGrainTable(*solver_),
              MakeContactRows(*solver_, dt));
}

/// Deep overlaps at the start are legal, and worth a word: a tenth of the mean radius is no rounding.
void SceneRun::NoteDeepOverlaps(double mean_radius) {
  const DeepContacts mine = FindDeepContacts(*solver_, 0.1 * mean_radius);
  const std::int64_t count = ranks_.Sum(mine.count);
  if (count == 0) return;
  const auto picometres = [](double depth) { return static_cast<std::int64_t>(std::min(depth * 1e12, 9e18)); };
  const std::int64_t deepest = -ranks_.Min(-picometres(mine.deepest));
  overlap_note_ = fmt::format("note: {} contact{} began deeper than a tenth of the mean radius, the deepest by {:.3g} m", count,
                              count == 1 ? "" : "s", static_cast<double>(deepest) * 1e-12);
}

void SceneRun::CloseResults() {
  file_->Close();
  const std::vector<FileExtent> tables = csv_->Keep();
  csv_->Close();
  const BodyRoles roles(plan_.scene);
  WriteFinalCsv(folder_.get(), MakeGrainTable(*solver_), [&](std::int64_t id) { return roles.Of(id); });
  if (!plan_.scene.output.packing.empty()) {
    std::string omissions;
    ranks_.RunOnRoot([&] {
      omissions = WritePacking(plan_.scene, folder_->Stage("final.csv"), folder_->Stage(plan_.scene.output.packing));
    });
    if (!omissions.empty()) Note(omissions);
  }
  WriteState(plan_, clock_, tables, *solver_, folder_.get());
  if (plan_.pilot) {
    folder_->Count("escalations", plan_.pilot->escalations());
    folder_->Count("descents", plan_.pilot->descents());
  }
  folder_->Finish();
}

void SceneRun::PrintSummary(bool stopped) {
  if (!ranks_.is_root()) return;
  summary_.seconds_wall = seconds_before_ + watch_.seconds();
  if (!request_.quiet) {
    fmt::print("{}", FormatSummary(summary_));
    if (!overlap_note_.empty()) fmt::print("{}\n", overlap_note_);
    if (plan_.pilot) fmt::print("{}\n", plan_.pilot->Summary());
  }
  if (stopped) {
    fmt::print(stderr, "nscdd: stopped at step {}, which did not converge (solver.on_nonconvergence = \"stop\"): {}\n",
               summary_.last.step, summary_.last.solve.reason);
  }
}

int SceneRun::SayHowToResume() {
  if (ranks_.is_root()) {
    fmt::print(stderr, "nscdd: told to end by a signal; {} of {} steps are done and kept: '{}' goes on from there\n",
               checkpoints_->last_step(), plan_.record.steps, checkpoints_->command());
  }
  return kInterruptedCode;
}

}  // namespace

int Run(const RunRequest& request, const MpiSession& session) { return SceneRun(request, session).Execute(); }

}  // namespace nscdd
