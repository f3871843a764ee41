// SPDX-License-Identifier: Apache-2.0
// The functions of the C interface and the one exported symbol.
#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "guard.h"
#include "nscdd/callback/abi_check.h"
#include "report_copy.h"
#include "solver_handle.h"
#include "solver_infos.h"

struct nscdd_solver {
  std::unique_ptr<nscdd::SolverHandle> handle;
  std::string sentence;
  bool busy = false;  // inside step, solve or a state function; a host callback must not come back in
};

namespace nscdd {
namespace {

// Null pointers and headers are faults of the calling code, hence BadCall.
template <class Structure>
void Need(const Structure* structure, const char* name, std::uint64_t size = sizeof(Structure)) {
  if (structure == nullptr) throw BadCall(fmt::format("the pointer to {} is null", name));
  try {
    CheckAbiHeader(structure->header, size, name);
  } catch (const Error& e) {
    throw BadCall(e.what());
  }
}

template <class Function>
std::int32_t WithHandle(nscdd_solver* solver, const char* name, Function&& function) noexcept {
  if (solver == nullptr) return NSCDD_BAD_CALL;
  if (solver->busy) return NSCDD_BAD_CALL;  // its sentence belongs to the call that is running
  solver->busy = true;
  solver->sentence.clear();
  const std::int32_t result = Guard(&solver->sentence, [&] { function(*solver->handle); });
  if (result != NSCDD_OK && solver->sentence.empty()) SetSentence(&solver->sentence, name);
  solver->busy = false;
  return result;
}

/// Cut to the buffer, always terminated.
void PutSentence(const std::string& sentence, char* error, std::uint64_t error_size) {
  if (error == nullptr || error_size == 0) return;
  const std::size_t length = std::min<std::size_t>(sentence.size(), static_cast<std::size_t>(error_size) - 1);
  std::memcpy(error, sentence.data(), length);
  error[length] = '\0';
}

std::int32_t Create(const nscdd_create_arguments* arguments, nscdd_solver** solver, char* error, std::uint64_t error_size) {
  std::string sentence;
  if (solver != nullptr) *solver = nullptr;
  const std::int32_t result = Guard(&sentence, [&] {
    if (solver == nullptr) throw BadCall("create: the pointer to the new solver is null");
    Need(arguments, "nscdd_create_arguments");
    auto created = std::make_unique<nscdd_solver>();
    created->handle = std::make_unique<SolverHandle>(*arguments);
    *solver = created.release();
  });
  PutSentence(sentence, error, error_size);
  return result;
}

std::int32_t CheckOption(const char* solver, const char* name, const char* value, char* error, std::uint64_t error_size) {
  std::string sentence;
  const std::int32_t result = Guard(&sentence, [&] {
    if (solver == nullptr || name == nullptr || value == nullptr) {
      throw BadCall("check_option: the name of the solver, the name of the option or its value is null");
    }
    MakeSettings(FindSolver(solver), {{name, value}});
  });
  PutSentence(sentence, error, error_size);
  return result;
}

void Destroy(nscdd_solver* solver) { delete solver; }

std::int32_t Step(nscdd_solver* solver, double dt) {
  return WithHandle(solver, "step", [&](SolverHandle& handle) { handle.Step(dt); });
}

std::int32_t Solve(nscdd_solver* solver, const nscdd_problem* problem, nscdd_solution* solution) {
  return WithHandle(solver, "solve", [&](SolverHandle& handle) {
    Need(problem, "nscdd_problem");
    Need(solution, "nscdd_solution");
    handle.Solve(*problem, solution);
  });
}

std::int32_t Report(nscdd_solver* solver, nscdd_report* report) {
  return WithHandle(solver, "report", [&](SolverHandle& handle) {
    Need(report, "nscdd_report", report == nullptr ? 0 : ReportSize(report->header.abi_minor));
    handle.Report(report);
  });
}

std::int32_t Table(nscdd_solver* solver, const char* name, nscdd_table* table) {
  return WithHandle(solver, "table", [&](SolverHandle& handle) {
    if (name == nullptr) throw BadCall("table: the name is null");
    Need(table, "nscdd_table");
    handle.Table(name, table);
  });
}

std::int32_t StateSize(nscdd_solver* solver, std::uint64_t* size) {
  return WithHandle(solver, "state_size", [&](SolverHandle& handle) {
    if (size == nullptr) throw BadCall("state_size: the pointer to the size is null");
    *size = handle.SaveState().size();
  });
}

std::int32_t SaveState(nscdd_solver* solver, void* bytes, std::uint64_t size) {
  return WithHandle(solver, "save_state", [&](SolverHandle& handle) {
    const std::vector<std::byte> state = handle.SaveState();
    if (bytes == nullptr || size != state.size()) {
      throw BadCall(fmt::format("save_state: the state has {} bytes, {} were given at {}; ask state_size before", state.size(),
                                size, bytes == nullptr ? "null" : "the pointer"));
    }
    std::memcpy(bytes, state.data(), state.size());
  });
}

std::int32_t LoadState(nscdd_solver* solver, const void* bytes, std::uint64_t size) {
  return WithHandle(solver, "load_state", [&](SolverHandle& handle) { handle.LoadState(bytes, size); });
}

std::int32_t LoadStates(nscdd_solver* solver, std::uint64_t count, const void* const* parts, const std::uint64_t* sizes) {
  return WithHandle(solver, "load_states", [&](SolverHandle& handle) { handle.LoadStates(count, parts, sizes); });
}

const char* LastError(nscdd_solver* solver) {
  return solver == nullptr ? "the solver handle is a null pointer; create one first" : solver->sentence.c_str();
}

nscdd_plugin MakeDescription() {
  nscdd_plugin plugin{};
  plugin.header = MakeAbiHeader(sizeof(nscdd_plugin));
  plugin.name = "nscdd";
  plugin.version = NSCDD_VERSION;
  plugin.mpi_library = NSCDD_MPI_LIBRARY;
  plugin.solver_count = SolverInfos().size();
  plugin.solvers = SolverInfos().data();
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
  return plugin;
}

}  // namespace
}  // namespace nscdd

extern "C" __attribute__((visibility("default"))) const nscdd_plugin* nscdd_plugin_entry(void) {
  try {
    static const nscdd_plugin plugin = nscdd::MakeDescription();
    return &plugin;
  } catch (...) {
    return nullptr;  // no memory for the tables
  }
}
