#include "commands/run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "auto/pilot.h"
#include "nscdd/error.h"
#include "nscdd/host/adapter_host.h"
#include "results/final_csv.h"
#include "results/progress_bar.h"
#include "results/results_file.h"
#include "results/results_folder.h"
#include "results/run_summary.h"
#include "results/steps_csv.h"
#include "run_results.h"
#include "scene/packing.h"
#include "scene/platform.h"
#include "scene/read_scene.h"

namespace nscdd {
namespace {

/// A run in the making; members in the order in which they come to be.
class SceneRun {
 public:
  SceneRun(const RunRequest& request, const MpiSession& session)
      : request_(request), ranks_(session.ranks()), session_(session), start_(std::chrono::steady_clock::now()) {}

  int Execute() {
    ranks_.RunTogether([&] { Prepare(); });
    ranks_.RunOnRoot([&] { CheckIds(scene_); });
    ranks_.RunTogether([&] { AddBodies(); });
    host_ = std::make_unique<AdapterHost>(&platform_->adapter());
    solver_ = std::make_unique<Solver>(
        registry_.Create({choice_.name, choice_.options, host_->table(), session_.solver_communicator()}));
    OpenResults();
    const bool stopped = Steps();
    CloseResults();
    PrintSummary(stopped);
    return stopped ? 3 : 0;
  }

 private:
  void Prepare();
  void AddBodies();
  void OpenResults();
  bool Steps();
  void Save(const StepRow& row);
  void NoteDeepOverlaps(double mean_radius);
  void CloseResults();
  void PrintSummary(bool stopped);
  RunIdentity Identity() const;

  const RunRequest& request_;
  const RankGroup& ranks_;
  const MpiSession& session_;
  std::chrono::steady_clock::time_point start_;
  Scene scene_;
  SolverRegistry registry_;
  SolverChoice choice_;
  std::string adapter_;
  std::int64_t steps_ = 0;
  std::int64_t subdomains_x_ = 1, subdomains_y_ = 1;
  std::unique_ptr<Platform> platform_;
  ShapeTable shapes_;
  std::unique_ptr<AdapterHost> host_;
  std::unique_ptr<Solver> solver_;
  std::unique_ptr<Pilot> pilot_;  // null unless the solver is "auto"
  std::unique_ptr<ResultsFolder> folder_;
  std::unique_ptr<StepsCsv> csv_;
  std::unique_ptr<ResultsFile> file_;
  RunSummary summary_;
  std::string overlap_note_;
};

void SceneRun::Prepare() {
  scene_ = ReadSceneFile(request_.scene);
  registry_.Add(FindPlugin(request_.solver.plugin));
  pilot_ = Pilot::Make(scene_, request_.solver, registry_, ranks_.size());
  choice_ = pilot_ ? pilot_->choice() : ChooseSolver(scene_, request_.solver, registry_);
  adapter_ = request_.adapter.empty() ? scene_.adapter : request_.adapter;
  steps_ = request_.steps.value_or(scene_.time.steps);
  const std::string grid = OptionValue(choice_, registry_, "subdomains");
  if (!grid.empty()) {
    const auto cross = grid.find('x');
    subdomains_x_ = std::stoll(grid.substr(0, cross));
    subdomains_y_ = std::stoll(grid.substr(cross + 1));
  }
  platform_ = MakePlatform(adapter_, scene_);
}

void SceneRun::AddBodies() {
  ForEachBody(scene_, ranks_.rank(), ranks_.size(), [&](const BodyDefinition& body) {
    platform_->Add(body);
    AddShapes(body, &shapes_);
  });
}

RunIdentity SceneRun::Identity() const {
  RunIdentity identity{scene_.name, scene_.file.string(), HashOfFile(scene_.file), NSCDD_VERSION, {}};
  identity.settings = {{"adapter", adapter_}, {"ranks", std::to_string(ranks_.size())}, {"steps", std::to_string(steps_)},
                       {"solver", choice_.name}};
  identity.settings.insert(identity.settings.end(), choice_.options.begin(), choice_.options.end());
  return identity;
}

void SceneRun::OpenResults() {
  std::filesystem::path out = request_.out;
  if (out.empty()) out = scene_.output.dir;
  if (out.empty()) out = std::filesystem::path("results") / scene_.name;
  folder_ = std::make_unique<ResultsFolder>(out, Identity(), ranks_);
  csv_ = std::make_unique<StepsCsv>(folder_.get());
  RunDescription run;
  run.scene = scene_.name;
  run.solver = choice_.name;
  run.version = NSCDD_VERSION;
  run.subdomains_x = subdomains_x_;
  run.subdomains_y = subdomains_y_;
  if (scene_.periodic) {
    run.period = scene_.periodic->length;
    run.period_origin = scene_.periodic->origin;
  }
  file_ = std::make_unique<ResultsFile>(folder_.get(), run, shapes_);
  summary_.scene = scene_.name;
  summary_.adapter = adapter_;
  summary_.solver = pilot_ ? "auto" : choice_.name;
  summary_.criterion =
      fmt::format("{} <= {}", OptionValue(choice_, registry_, "criterion"), OptionValue(choice_, registry_, "tolerance"));
  if (pilot_) summary_.criterion = "of the rung in use";
  summary_.output = out.string();
  summary_.ranks = ranks_.size();
  summary_.subdomains_x = subdomains_x_;
  summary_.subdomains_y = subdomains_y_;
  summary_.steps_asked = steps_;
}

/// True when a step that did not converge ended the run.
bool SceneRun::Steps() {
  ProgressBar bar(stdout, ranks_.is_root() ? ProgressBar::StyleFor(stdout, request_.quiet) : ProgressBar::Style::kNone, steps_);
  const std::int64_t every = request_.save_every.value_or(scene_.output.save_every.value_or(0));
  for (std::int64_t step = 1; step <= steps_; ++step) {
    platform_->SetGravity(GravityAt(scene_.gravity, step, scene_.time.dt));
    solver_->Step(scene_.time.dt);
    const StepReport report = solver_->Report();
    const StepRow row = MakeStepRow(report);
    folder_->KeepParts();
    csv_->Append(row);
    summary_.Add(row);
    bar.Update(row);
    const bool good = report.solve.status == SolveStatus::kConverged || report.solve.status == SolveStatus::kIncomplete;
    const bool stop = !good && scene_.solver.on_nonconvergence == OnNonconvergence::kStop;
    if (step == 1) {
      summary_.unknowns_per_contact = report.solve.unknowns_per_contact;
      summary_.unknowns_per_body = report.solve.unknowns_per_body;
      summary_.bytes_per_contact = report.solve.bytes_per_contact;
      summary_.bytes_per_body = report.solve.bytes_per_body;
      NoteDeepOverlaps(report.mean_radius);
    }
    if (step == 1 || step == steps_ || stop || (every > 0 && step % every == 0)) Save(row);
    if (stop) return true;
    if (pilot_) {
      pilot_->AfterStep(report, scene_.time.dt, step < steps_, ranks_, session_, *host_, &platform_->adapter(), solver_.get());
    }
  }
  return false;
}

void SceneRun::Save(const StepRow& row) {
  file_->Save({row.step, row.time, row.mean_radius}, MakeGrainTable(*solver_), MakeContactRows(*solver_));
}

/// Deep overlaps at the start are legal, and worth a word: a tenth of the mean radius is no rounding.
void SceneRun::NoteDeepOverlaps(double mean_radius) {
  const DeepContacts mine = FindDeepContacts(*solver_, 0.1 * mean_radius);
  const std::int64_t count = ranks_.Sum(mine.count);
  if (count == 0) return;
  const auto picometres = [](double depth) { return static_cast<std::int64_t>(depth * 1e12); };
  const std::int64_t deepest = -ranks_.Min(-picometres(mine.deepest));
  overlap_note_ = fmt::format("note: {} contact{} began deeper than a tenth of the mean radius, the deepest by {:.3g} m", count,
                              count == 1 ? "" : "s", static_cast<double>(deepest) * 1e-12);
}

void SceneRun::CloseResults() {
  file_->Close();
  csv_->Close();
  WriteFinalCsv(folder_.get(), MakeGrainTable(*solver_));
  if (!scene_.output.packing.empty()) {
    ranks_.RunOnRoot([&] { WritePacking(scene_, folder_->Stage("final.csv"), folder_->Stage(scene_.output.packing)); });
  }
  if (pilot_) {
    folder_->Count("escalations", pilot_->escalations());
    folder_->Count("descents", pilot_->descents());
  }
  folder_->Finish();
}

void SceneRun::PrintSummary(bool stopped) {
  if (!ranks_.is_root()) return;
  summary_.seconds_wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (!request_.quiet) {
    fmt::print("{}", FormatSummary(summary_));
    if (!overlap_note_.empty()) fmt::print("{}\n", overlap_note_);
    if (pilot_) fmt::print("{}\n", pilot_->Summary());
  }
  if (stopped) {
    fmt::print(stderr, "nscdd: stopped at step {}, which did not converge (solver.on_nonconvergence = \"stop\"): {}\n",
               summary_.last.step, summary_.last.reason);
  }
}

}  // namespace

int Run(const RunRequest& request, const MpiSession& session) { return SceneRun(request, session).Execute(); }

}  // namespace nscdd
