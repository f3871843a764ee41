// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <cmath>
#include <functional>
#include <span>

#include "nscdd/host/solver.h"
#include "validator/check_list.h"
#include "validator/two_disk_host.h"

// Of the address sanitizer's allocator, about which mallinfo2 knows nothing; null without that sanitizer.
extern "C" __attribute__((weak)) std::size_t __sanitizer_get_current_allocated_bytes();

namespace nscdd {
namespace {

constexpr double kTimeStep = 0.05;  // [s] with speeds of 1 m/s the disks meet in the eleventh step
constexpr int kSteps = 15;

Solver MakeSolver(std::shared_ptr<const PluginLibrary> library, const std::string& name, TwoDiskHost* host) {
  return Solver(std::move(library), {.solver = name, .options = {}, .host = host->table(), .communicator = {}});
}

std::size_t AllocatedBytes() {
  return __sanitizer_get_current_allocated_bytes != nullptr ? __sanitizer_get_current_allocated_bytes() : mallinfo2().uordblks;
}

void CreateAndDestroy(const std::string& path) {
  constexpr int kWarmUp = 50, kTimes = 1000;
  constexpr std::size_t kAllowed = 64 * 1024;  // [bytes] for what an allocator keeps; 1000 leaks of 64 bytes are caught
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    TwoDiskHost host;
    std::size_t before = 0;
    for (int i = 0; i < kWarmUp + kTimes; ++i) {
      if (i == kWarmUp) before = AllocatedBytes();
      const Solver solver = MakeSolver(library, name, &host);
    }
    const std::size_t after = AllocatedBytes();
    Expect(after < before + kAllowed,
           fmt::format("{} handles created and destroyed left {} bytes behind; free what create allocates", kTimes,
                       after - before));
  });
}

void StepsTwoDisks(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    TwoDiskHost host;
    Solver solver = MakeSolver(library, name, &host);
    for (int i = 0; i < kSteps; ++i) solver.Step(kTimeStep);
    Expect(host.commits() == kSteps, fmt::format("{} steps committed {} times", kSteps, host.commits()));
    for (const double v : host.velocity()) {
      Expect(std::abs(v) < 1e-3, fmt::format("after a central impact without restitution a velocity of {} is left, not 0", v));
    }
    Expect(std::abs(host.gap()) < 0.1,
           fmt::format("two disks that met without restitution have the gap {} m, not 0", host.gap()));
    const StepReport report = solver.Report();
    Expect(report.step == kSteps, fmt::format("the report counts step {} after {} steps", report.step, kSteps));
    Expect(solver.Table("bodies").rows() == 2, "the table 'bodies' must have two rows");
    Expect(solver.Table("contacts").rows() == 1, "the table 'contacts' must have one row");
    Expect(solver.Table("bodies").Integer("id")[1] == 7, "the table 'bodies' must have the ids in ascending order");
  });
}

std::array<double, 6> PoseAlone(const std::shared_ptr<const PluginLibrary>& library, const std::string& name, double speed) {
  TwoDiskHost host(speed);
  Solver solver = MakeSolver(library, name, &host);
  for (int i = 0; i < kSteps; ++i) solver.Step(kTimeStep);
  return host.pose();
}

void TwoHandles(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    TwoDiskHost slow(0.7), fast(1.3);
    Solver first = MakeSolver(library, name, &slow), second = MakeSolver(library, name, &fast);
    for (int i = 0; i < kSteps; ++i) {
      first.Step(kTimeStep);
      second.Step(kTimeStep);
    }
    const bool same = slow.pose() == PoseAlone(library, name, 0.7) && fast.pose() == PoseAlone(library, name, 1.3);
    Expect(same, "two handles used in turn give other results than each alone; keep all state in the handle");
    Expect(first.Report().step == kSteps,
           fmt::format("one of two handles counts {} steps, not {}", first.Report().step, kSteps));
  });
}

/// `load` gives the bytes to the new handle by the function `function`.
void CheckContinuation(const std::shared_ptr<const PluginLibrary>& library, const std::string& name, const char* function,
                       const std::function<void(const std::vector<std::byte>&, Solver*)>& load) {
  TwoDiskHost host;
  Solver solver = MakeSolver(library, name, &host);
  for (int i = 0; i < kSteps; ++i) solver.Step(kTimeStep);
  TwoDiskHost copy = host;
  Solver resumed = MakeSolver(library, name, &copy);
  load(solver.SaveState(), &resumed);
  solver.Step(kTimeStep);
  resumed.Step(kTimeStep);
  Expect(host.pose() == copy.pose() && host.velocity() == copy.velocity(),
         fmt::format("a handle that loaded another's state by {} goes on differently; save everything that a step uses",
                     function));
  Expect(resumed.Report().step == kSteps + 1 && std::abs(resumed.Report().time - solver.Report().time) < 1e-12,
         fmt::format("after {} the report counts step {}, not {}", function, resumed.Report().step, kSteps + 1));
}

void StateRoundTrip(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  ForEachSolver(*library, [&](const std::string& name) {
    CheckContinuation(library, name, "load_state", [](const auto& bytes, Solver* solver) { solver->LoadState(bytes); });
    if (library->plugin().header.abi_minor < 1) return;
    CheckContinuation(library, name, "load_states", [](const auto& bytes, Solver* solver) {
      const std::span<const std::byte> part(bytes);
      solver->LoadStates({&part, 1});
    });
  });
}

void LeavesMpiAlone(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  // Through the plugin's own dependencies; null when it uses no MPI.
  const auto initialized = reinterpret_cast<int (*)(int*)>(library->FindSymbol("MPI_Initialized"));
  int before = 0;  // not 0 where this program was started by mpirun
  if (initialized != nullptr) initialized(&before);
  ForEachSolver(*library, [&](const std::string& name) {
    TwoDiskHost host;
    Solver solver = MakeSolver(library, name, &host);
    solver.Step(kTimeStep);
    int started = 0;
    if (initialized != nullptr) initialized(&started);
    Expect(started == before, "it initialised MPI though distributed is 0; leave that to the host");
  });
}

}  // namespace

std::vector<Check> HandleChecks() {
  return {
      {"1000 handles leave no memory behind", CreateAndDestroy}, {"steps two disks of a C host", StepsTwoDisks},
      {"two handles do not disturb each other", TwoHandles},     {"a saved state goes on in another handle", StateRoundTrip},
      {"leaves MPI alone when not distributed", LeavesMpiAlone},
  };
}

}  // namespace nscdd
