// SPDX-License-Identifier: Apache-2.0
// Contact updates per second of the NLGS sweep beside a bare loop: README.md says how to run it and to read the ratios.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <memory>
#include <string>

#include "bare_sweep.h"
#include "dense_packing.h"
#include "nlgs/residual.h"
#include "nlgs/sweep.h"
#include "nscdd/error.h"

namespace nscdd::benchmark {
namespace {

/// CPU time of this thread [s]: what other programs do on the machine costs cache, but is not counted as such.
double ThreadSeconds() {
  std::timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Made when a benchmark first asks for it.
class LazyPacking {
 public:
  LazyPacking(int disks, double friction) : disks_(disks), friction_(friction) {}
  const DensePacking& Get() {
    if (!packing_) packing_ = std::make_unique<DensePacking>(MakeDensePacking(disks_, friction_));
    return *packing_;
  }

 private:
  int disks_;
  double friction_;
  std::unique_ptr<DensePacking> packing_;
};

using Pass = std::function<void(const SubdomainProblem&, SubdomainState*)>;

void ProductPass(const SubdomainProblem& problem, SubdomainState* state) { Sweep(problem, state); }

void StatisticsPass(const SubdomainProblem& problem, SubdomainState* state) {
  ::benchmark::DoNotOptimize(SweepWithStatistics(problem, state));
}

void ResidualPass(const SubdomainProblem& problem, SubdomainState* state) {
  ::benchmark::DoNotOptimize(NaturalResidual(problem, *state));
}

void BarePass(const SubdomainProblem& problem, SubdomainState* state) {
  if (problem.model == ContactModel::kFriction) {
    BareSweep(problem.friction, problem.inverse_mass.data(), state->velocity.data(), state->impulse.data());
  } else {
    BareSweep(problem.normal, problem.inverse_mass.data(), state->velocity.data(), state->impulse.data());
  }
}

/// Some passes from the same state each time, so that every iteration meets the same active set and no sweep is at a fixed
/// point.
void Measure(::benchmark::State& run, LazyPacking* lazy, const Pass& pass) {
  const DensePacking& packing = lazy->Get();
  const SubdomainProblem& problem = packing.problem;
  const auto contacts = static_cast<std::int64_t>(problem.contact_count());
  const std::int64_t passes = std::max<std::int64_t>(4, 100'000 / contacts);
  SubdomainState state = packing.state;
  for (auto _ : run) {
    state = packing.state;
    const double start = ThreadSeconds();
    for (std::int64_t k = 0; k < passes; ++k) pass(problem, &state);
    run.SetIterationTime(ThreadSeconds() - start);
  }
  run.SetItemsProcessed(run.iterations() * passes * contacts);
  run.counters["contacts"] = static_cast<double>(contacts);
  run.counters["active"] = packing.active;
  run.counters["packet"] = static_cast<double>(contacts) / static_cast<double>(problem.packet_begin.size() - 1);
}

/// A benchmark of two loops that do not compute the same would compare nothing.
void CheckBareLoop(LazyPacking* lazy) {
  const DensePacking& packing = lazy->Get();
  SubdomainState product = packing.state, bare = packing.state;
  ProductPass(packing.problem, &product);
  BarePass(packing.problem, &bare);
  double largest = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < bare.velocity.size(); ++i) {
    largest = std::max(largest, std::abs(bare.velocity[i]));
    difference = std::max(difference, std::abs(bare.velocity[i] - product.velocity[i]));
  }
  if (!(difference <= 1e-12 * largest)) {
    throw Error(
        fmt::format("after one sweep the bare loop and the product differ by {} m/s; mend bare_sweep.cpp.", difference));
  }
}

void Register(const std::string& law, double friction, int disks) {
  const auto packing = std::make_shared<LazyPacking>(disks, friction);
  const auto add = [&](const char* what, const Pass& pass) {
    ::benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", law, disks, what).c_str(), [packing, pass](::benchmark::State& run) {
      Measure(run, packing.get(), pass);
    })->UseManualTime();
  };
  add("product", ProductPass);
  add("bare", BarePass);
  add("statistics", StatisticsPass);
  add("residual", ResidualPass);
}

}  // namespace
}  // namespace nscdd::benchmark

int main(int argc, char** argv) {
  using namespace nscdd::benchmark;
  for (const double friction : {0.0, 0.3}) {
    LazyPacking small(730, friction);
    CheckBareLoop(&small);
    for (const int disks : {730, 10'000, 100'000}) Register(friction > 0.0 ? "friction" : "frictionless", friction, disks);
  }
  ::benchmark::Initialize(&argc, argv);
  if (::benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  ::benchmark::RunSpecifiedBenchmarks();
  ::benchmark::Shutdown();
  return 0;
}
