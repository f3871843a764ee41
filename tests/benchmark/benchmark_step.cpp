// SPDX-License-Identifier: Apache-2.0
// A scene's whole steps on one core: ours through the Box2D adapter beside Box2D's own Step. README.md explains the columns.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "nscdd/error.h"
#include "nscdd/interpenetration.h"
#include "scene/body_stream.h"
#include "scene/gravity.h"
#include "scene/read_scene.h"
#include "stopwatch.h"
#include "tradeoff/contestant.h"
#include "tradeoff/course.h"
#include "tradeoff/tradeoff_row.h"

namespace nscdd::benchmark {
namespace {

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double Max(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// A contestant that can begin again from the same start.
struct Entry {
  Setting setting;
  bool continuous = true;  ///< Box2D's time-of-impact stage
};

/// What all runs share.
struct Race {
  Scene scene;
  std::int64_t steps = 0;
  SolverRegistry registry;
  SteppingOptions stepping;

  std::unique_ptr<Contestant> Start(const Entry& entry) const {
    if (entry.setting.is_box2d()) return MakeBox2dContestant(scene, entry.setting, entry.continuous);
    Setting setting = entry.setting;
    setting.options.emplace_back("alert_distance", fmt::format("{}", stepping.alert_distance));
    return MakePluginContestant(scene, "box2d", registry, setting);
  }
  Vec2 Gravity(std::int64_t step) const { return GravityAt(scene.gravity, step, scene.time.dt); }
};

/// What an entry did, one number a run or a step.
struct Record {
  std::vector<double> milliseconds;  // per step, mean of each run
  std::vector<double> sweeps, mean_interpenetration, max_interpenetration;
  std::vector<double> nat, nat_max, nat_on_reported, nat_max_on_reported, imbalance, candidates, reported, active, unmatched;
};

/// From the same start; the machine's first steps (contacts found, memory taken) count.
void TimeRun(const Entry& entry, const Race& race, Record* record) {
  const std::unique_ptr<Contestant> contestant = race.Start(entry);
  const double start = ProcessSeconds();
  for (std::int64_t k = 1; k <= race.steps; ++k) {
    contestant->SetGravity(race.Gravity(k));
    contestant->Step(race.scene.time.dt);
  }
  record->milliseconds.push_back(1e3 * (ProcessSeconds() - start) / static_cast<double>(race.steps));
}

/// Residuals of a step's answer on our contacts, on all of them and on those only that the contestant reported.
void MeasureAnswers(const StepProblem& problem, const std::map<ContactKey, Vec2>& impulses, const Answer& answer,
                    Record* record) {
  std::vector<bool> is_reported;
  double reported = 0.0, active = 0.0, matched = 0.0;
  for (const ContactKey& key : problem.keys) {
    const auto own = impulses.find(key);
    is_reported.push_back(own != impulses.end());
    matched += own != impulses.end() && own->second.x > 0.0;
  }
  for (const auto& [key, r] : impulses) {
    reported += 1.0;
    active += r.x > 0.0;
  }
  const AnswerResiduals all = MeasureAnswer(problem.problem, answer),
                        on_reported = MeasureAnswer(problem.problem, answer, is_reported);
  record->nat.push_back(all.nat);
  record->nat_max.push_back(all.nat_max);
  record->nat_on_reported.push_back(on_reported.nat);
  record->nat_max_on_reported.push_back(on_reported.nat_max);
  record->imbalance.push_back(all.momentum_defect);
  record->candidates.push_back(static_cast<double>(problem.keys.size()));
  record->reported.push_back(reported);
  record->active.push_back(active);
  record->unmatched.push_back(active - matched);
}

/// The yardstick, put to an answer whose residual the core has measured itself.
void CheckAgainstReport(double measured, double reported, std::int64_t step) {
  if (reported < 0.0 || std::abs(measured - reported) <= 1e-6 * reported + 1e-12) return;
  throw Error(
      fmt::format("step {}: nat is {} here and {} in the solver's report; MeasureAnswer() must measure what the "
                  "core measures.",
                  step, measured, reported));
}

void MeasureRun(const Entry& entry, const Race& race, Record* record) {
  const std::unique_ptr<Contestant> contestant = race.Start(entry);
  contestant->KeepImpulses(true);
  for (std::int64_t k = 1; k <= race.steps; ++k) {
    contestant->SetGravity(race.Gravity(k));
    const StepProblem problem = contestant->Read(race.stepping, race.scene.time.dt);
    contestant->Step(race.scene.time.dt);
    const StepEnd end = ReadStepEnd(contestant.get(), problem);
    MeasureAnswers(problem, contestant->impulses(), end.answer, record);
    const Effort effort = contestant->LastEffort();
    CheckAgainstReport(record->nat.back(), effort.reported_nat, k);
    record->sweeps.push_back(static_cast<double>(effort.sweeps));
    const Interpenetration overlap =
        MeasureInterpenetration(&contestant->adapter(), problem.bodies.id, end.pose, race.stepping.alert_distance);
    record->mean_interpenetration.push_back(overlap.mean);
    record->max_interpenetration.push_back(overlap.max);
  }
}

void PrintCost(const std::vector<Entry>& entries, const std::vector<Record>& records) {
  fmt::print(
      "\n| solver | ms per step, median | least .. most | sweeps per step | interpenetration, mean [m] | largest [m] |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Record& r = records[i];
    fmt::print("| {} | {:.2f} | {:.2f} .. {:.2f} | {:.0f} | {:.1e} | {:.1e} |\n", entries[i].setting.name,
               Median(r.milliseconds), *std::min_element(r.milliseconds.begin(), r.milliseconds.end()), Max(r.milliseconds),
               Mean(r.sweeps), Mean(r.mean_interpenetration), Max(r.max_interpenetration));
  }
}

void PrintResiduals(const std::vector<Entry>& entries, const std::vector<Record>& records) {
  fmt::print(
      "\n| solver | nat, median | worst step | nat_max, median | worst step | nat, reported contacts | nat_max, reported "
      "contacts | "
      "imbalance | our candidates | reported | r_n > 0 | unmatched |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Record& r = records[i];
    fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.0e} | {:.0f} | {:.0f} | {:.0f} | {:.2f} |\n",
               entries[i].setting.name, Median(r.nat), Max(r.nat), Median(r.nat_max), Max(r.nat_max), Median(r.nat_on_reported),
               Median(r.nat_max_on_reported), Median(r.imbalance), Mean(r.candidates), Mean(r.reported), Mean(r.active),
               Mean(r.unmatched));
  }
}

Entry Box2d(int velocity, int position, bool continuous = true) {
  return {{fmt::format("Box2D {}/{}{}", velocity, position, continuous ? "" : ", not continuous"),
           "box2d",
           {{"velocity_iterations", fmt::format("{}", velocity)}, {"position_iterations", fmt::format("{}", position)}}},
          continuous};
}
Entry Sweeps(const std::string& count) {
  return {{"nscd, " + count + " sweeps",
           "nscd",
           {{"acceleration", "none"}, {"tolerance", "0"}, {"max_iterations", count}, {"test_every", count}}}};
}
Entry Nat(const std::string& tolerance) {
  return {{"nscd, nat " + tolerance, "nscd", {{"acceleration", "none"}, {"tolerance", tolerance}}}};
}

/// As by default, with acceleration.
Entry AcceleratedNat(const std::string& tolerance) {
  return {{"nscd accelerated, nat " + tolerance, "nscd", {{"tolerance", tolerance}}}};
}

std::vector<Entry> Entries() {
  return {Box2d(8, 3),           Box2d(8, 3, false), Box2d(20, 10),          Box2d(50, 20),
          Sweeps("8"),           Sweeps("20"),       Sweeps("50"),           Nat("1e-2"),
          Nat("1e-3"),           Nat("1e-4"),        AcceleratedNat("1e-3"), AcceleratedNat("1e-4"),
          AcceleratedNat("1e-5")};
}

void Compare(const Race& race, int runs) {
  const std::vector<Entry> entries = Entries();
  std::vector<Record> records(entries.size());
  for (int run = 0; run < runs; ++run) {
    for (std::size_t i = 0; i < entries.size(); ++i) TimeRun(entries[i], race, &records[i]);
  }
  for (std::size_t i = 0; i < entries.size(); ++i) MeasureRun(entries[i], race, &records[i]);
  fmt::print("{}: {} steps of {} s, {} interleaved runs from the same start, one thread, CPU time\n", race.scene.name,
             race.steps, race.scene.time.dt, runs);
  PrintCost(entries, records);
  PrintResiduals(entries, records);
}

}  // namespace
}  // namespace nscdd::benchmark

int main(int argc, char** argv) {
  CLI::App app("Whole steps of a scene beside Box2D's own Step");
  std::string file = NSCDD_SAMPLE_SCENES "/rotating_box_730.toml";
  std::int64_t steps = 0;
  int runs = 11;
  app.add_option("scene", file, "Scene file of disks, not periodic")->capture_default_str();
  app.add_option("--steps", steps, "Steps; the scene's own number by default")->check(CLI::PositiveNumber);
  app.add_option("--runs", runs, "Timed runs of each solver")->check(CLI::PositiveNumber)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    nscdd::benchmark::Race race;
    race.scene = nscdd::ReadSceneFile(file);
    race.steps = steps > 0 ? steps : race.scene.time.steps;
    race.registry.Add(nscdd::FindPlugin(""));
    race.stepping.alert_distance = 0.1 * nscdd::MeanGrainRadius(race.scene);
    nscdd::benchmark::Compare(race, runs);
  } catch (const nscdd::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
