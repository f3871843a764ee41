// A scene's whole steps on one core: ours through the Box2D adapter beside Box2D's own Step. README.md explains the columns.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <numeric>
#include <vector>

#include "contestant.h"
#include "nscdd/error.h"
#include "scene/read_scene.h"

namespace nscdd::benchmark {
namespace {

/// CPU time of this thread [s]; neither contestant starts another one.
double ThreadSeconds() {
  std::timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}
double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double Max(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// What an entry did, one number a run or a step.
struct Record {
  std::vector<double> milliseconds;  // per step, mean of each run
  std::vector<double> sweeps, mean_interpenetration, max_interpenetration;
  std::vector<double> nat, nat_max, nat_on_reported, nat_max_on_reported, imbalance, candidates, reported, active, unmatched;
};

/// From the same start; the machine's first steps (contacts found, memory taken) count.
void TimeRun(const Entry& entry, const Scene& scene, std::int64_t steps, Record* record) {
  const std::unique_ptr<Contestant> contestant = entry.make(scene);
  const double start = ThreadSeconds();
  for (std::int64_t k = 1; k <= steps; ++k) contestant->Step(k);
  record->milliseconds.push_back(1e3 * (ThreadSeconds() - start) / static_cast<double>(steps));
}

void MeasureRun(const Entry& entry, const Scene& scene, std::int64_t steps, Record* record) {
  const std::unique_ptr<Contestant> contestant = entry.make(scene);
  for (std::int64_t k = 1; k <= steps; ++k) {
    const MeasuredStep step = contestant->StepAndMeasure(k);
    const Interpenetration overlap = MeasureInterpenetration(&contestant->adapter(), AlertDistance(scene));
    record->sweeps.push_back(static_cast<double>(step.sweeps));
    record->mean_interpenetration.push_back(overlap.mean);
    record->max_interpenetration.push_back(overlap.max);
    record->nat.push_back(step.residuals.nat);
    record->nat_max.push_back(step.residuals.nat_max);
    record->nat_on_reported.push_back(step.on_reported.nat);
    record->nat_max_on_reported.push_back(step.on_reported.nat_max);
    record->imbalance.push_back(step.residuals.imbalance);
    record->candidates.push_back(static_cast<double>(step.candidates));
    record->reported.push_back(static_cast<double>(step.reported));
    record->active.push_back(static_cast<double>(step.active));
    record->unmatched.push_back(static_cast<double>(step.unmatched));
  }
}

void PrintCost(const std::vector<Entry>& entries, const std::vector<Record>& records) {
  fmt::print(
      "\n| solver | ms per step, median | least .. most | sweeps per step | interpenetration, mean [m] | largest [m] |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Record& r = records[i];
    fmt::print("| {} | {:.2f} | {:.2f} .. {:.2f} | {:.0f} | {:.1e} | {:.1e} |\n", entries[i].name, Median(r.milliseconds),
               *std::min_element(r.milliseconds.begin(), r.milliseconds.end()), Max(r.milliseconds), Mean(r.sweeps),
               Mean(r.mean_interpenetration), Max(r.max_interpenetration));
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
               entries[i].name, Median(r.nat), Max(r.nat), Median(r.nat_max), Max(r.nat_max), Median(r.nat_on_reported),
               Median(r.nat_max_on_reported), Median(r.imbalance), Mean(r.candidates), Mean(r.reported), Mean(r.active),
               Mean(r.unmatched));
  }
}

std::vector<Entry> Entries() {
  return {Box2dEntry(8, 3, true), Box2dEntry(8, 3, false), Box2dEntry(20, 10, true), Box2dEntry(50, 20, true),
          OurBudgetEntry(8),      OurBudgetEntry(20),      OurBudgetEntry(50),       OurEntry(1e-2),
          OurEntry(1e-3),         OurEntry(1e-4)};
}

void Compare(const Scene& scene, std::int64_t steps, int runs) {
  const std::vector<Entry> entries = Entries();
  std::vector<Record> records(entries.size());
  for (int run = 0; run < runs; ++run) {
    for (std::size_t i = 0; i < entries.size(); ++i) TimeRun(entries[i], scene, steps, &records[i]);
  }
  for (std::size_t i = 0; i < entries.size(); ++i) MeasureRun(entries[i], scene, steps, &records[i]);
  fmt::print("{}: {} steps of {} s, {} interleaved runs from the same start, one thread, CPU time\n", scene.name, steps,
             scene.time.dt, runs);
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
    const nscdd::Scene scene = nscdd::ReadSceneFile(file);
    nscdd::benchmark::Compare(scene, steps > 0 ? steps : scene.time.steps, runs);
  } catch (const nscdd::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
