// SPDX-License-Identifier: Apache-2.0
// Our own plugin with one thing spoilt: the environment variable NSCDD_FAULT says which. "none" spoils nothing.
#include <dlfcn.h>
#include <mpi.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "nscdd_plugin.h"

#define EXPORT extern "C" __attribute__((visibility("default")))

namespace {

const nscdd_plugin* real = nullptr;  // a test tool may have globals: one process, one thread, one fault
nscdd_solver* shared = nullptr;
std::string fault;

bool Is(const char* name) { return fault == name; }

std::int32_t Create(const nscdd_create_arguments* given, nscdd_solver** solver, char* error, std::uint64_t size) {
  if (given == nullptr) {
    if (Is("null_arguments")) return NSCDD_OK;
    return real->create(given, solver, error, size);
  }
  nscdd_create_arguments arguments = *given;
  if (Is("leak")) (void)!std::memset(std::malloc(1000), 1, 1000);
  if (Is("mpi")) {
    int started = 0;
    MPI_Initialized(&started);
    if (started == 0) MPI_Init(nullptr, nullptr);
  }
  if (Is("any_option") && arguments.option_count > 0 && std::strcmp(arguments.option_names[0], "no_such_option") == 0) {
    arguments.option_count = 0;
  }
  if (Is("bad_default") && arguments.option_count > 0 && std::strcmp(arguments.option_names[0], "theta") == 0)
    return NSCDD_BAD_INPUT;
  if (Is("truncated")) arguments.header = {sizeof(nscdd_create_arguments), NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
  if (Is("long_sentence") && size > 0) {
    std::memset(error, '!', size);
    *solver = nullptr;
    return real->create(&arguments, solver, nullptr, 0);
  }
  if (Is("shared_handle") && shared != nullptr && arguments.host != nullptr) {
    *solver = shared;
    return NSCDD_OK;
  }
  const std::int32_t result = real->create(&arguments, solver, error, size);
  if (Is("shared_handle") && arguments.host != nullptr) shared = *solver;
  return result;
}

void Destroy(nscdd_solver* solver) {
  if (Is("shared_handle")) return;
  if (Is("destroy_null") && solver == nullptr) std::abort();
  real->destroy(solver);
}

std::int32_t Step(nscdd_solver* solver, double dt) {
  if (Is("any_dt") && !(dt > 0.0)) return NSCDD_OK;
  if (Is("slow_step")) dt *= 0.5;
  if (Is("host_failure") && real->step(solver, dt) != NSCDD_OK) return NSCDD_OK;
  if (Is("host_failure")) return NSCDD_OK;
  return real->step(solver, dt);
}

std::int32_t Solve(nscdd_solver* solver, const nscdd_problem* problem, nscdd_solution* solution) {
  const std::int32_t result = real->solve(solver, problem, solution);
  if (result != NSCDD_OK) return Is("nan") && problem != nullptr && problem->body_count == 2 ? NSCDD_OK : result;
  if (Is("tangential")) solution->impulse[1] = 0.0;
  if (Is("normal")) solution->impulse[0] *= 1.001;
  if (Is("sticky") && solution->impulse[0] == 0.0) solution->impulse[0] = 0.01;
  if (Is("inelastic") && problem->offset[0] < 0.0) solution->velocity[0] = solution->velocity[3] = 0.0;
  return result;
}

std::int32_t Report(nscdd_solver* solver, nscdd_report* report) {
  const std::int32_t result = real->report(solver, report);
  if (Is("blind") && result == NSCDD_OK) {
    report->status = NSCDD_CONVERGED;
    report->reason = "all is well";
  }
  if (Is("new_status") && result == NSCDD_OK) report->status = 77;
  return result;
}

std::int32_t Table(nscdd_solver* solver, const char* name, nscdd_table* table) { return real->table(solver, name, table); }
std::int32_t StateSize(nscdd_solver* solver, std::uint64_t* size) { return real->state_size(solver, size); }
std::int32_t SaveState(nscdd_solver* solver, void* bytes, std::uint64_t size) { return real->save_state(solver, bytes, size); }

std::int32_t LoadState(nscdd_solver* solver, const void* bytes, std::uint64_t size) {
  if (Is("no_load") && bytes != nullptr) return NSCDD_OK;
  const std::int32_t result = real->load_state(solver, bytes, size);
  return Is("any_state") && bytes != nullptr ? NSCDD_OK : result;
}

std::int32_t LoadStates(nscdd_solver* solver, std::uint64_t count, const void* const* parts, const std::uint64_t* sizes) {
  if (Is("no_load_states") && parts != nullptr && count > 0) return NSCDD_OK;
  const std::int32_t result = real->load_states(solver, count, parts, sizes);
  return Is("any_states") && parts != nullptr ? NSCDD_OK : result;
}

std::int32_t CheckOption(const char* solver, const char* name, const char* value, char* error, std::uint64_t size) {
  if (Is("any_checked_option")) return NSCDD_OK;
  if (Is("bad_checked_default") && name != nullptr && std::strcmp(name, "theta") == 0) return NSCDD_BAD_INPUT;
  return real->check_option(solver, name, value, error, size);
}

const char* LastError(nscdd_solver* solver) {
  if (Is("silent")) return "";
  return real->last_error(solver);
}

const nscdd_plugin* MakeDescription() {
  void* library = dlopen(PLUGIN_FILE, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return nullptr;
  real = reinterpret_cast<nscdd_plugin_entry_function>(dlsym(library, NSCDD_ENTRY_SYMBOL))();
  const char* name = std::getenv("NSCDD_FAULT");
  fault = name == nullptr ? "none" : name;
  static nscdd_plugin plugin;
  static std::vector<nscdd_solver_info> solvers;
  plugin = *real;
  solvers.assign(real->solvers, real->solvers + real->solver_count);
  if (Is("loud_name")) solvers[0].name = "NSCD!";
  plugin.solvers = solvers.data();
  plugin.create = Create;
  plugin.destroy = Destroy;
  plugin.step = Step;
  plugin.solve = Solve;
  plugin.report = Report;
  plugin.table = Table;
  plugin.state_size = StateSize;
  plugin.save_state = SaveState;
  plugin.load_state = LoadState;
  plugin.last_error = LastError;
  plugin.load_states = LoadStates;
  plugin.check_option = CheckOption;
  if (Is("old_minor")) {
    plugin.header = {offsetof(nscdd_plugin, load_states), NSCDD_ABI_MAJOR, 0};
    plugin.load_states = nullptr;
    plugin.check_option = nullptr;
  }
  return &plugin;
}

}  // namespace

EXPORT const nscdd_plugin* nscdd_plugin_entry(void) {
  static const nscdd_plugin* const plugin = MakeDescription();
  if (plugin != nullptr && Is("new_description")) return new nscdd_plugin(*plugin);
  return plugin;
}
