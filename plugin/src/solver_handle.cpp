// SPDX-License-Identifier: Apache-2.0
#include "solver_handle.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <span>
#include <sstream>

#include "guard.h"
#include "nscdd/agreement.h"
#include "nscdd/callback/abi_check.h"
#include "nscdd/contact_problem.h"
#include "nscdd/mpi_communicator.h"
#include "report_copy.h"
#include "single_problem.h"

namespace nscdd {
namespace {

constexpr std::uint64_t kMostOptions = 1000;

std::unique_ptr<Communicator> MakeCommunicator(const nscdd_create_arguments& arguments) {
  if (arguments.distributed == 0) return std::make_unique<SerialCommunicator>();
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  if (started == 0 || ended != 0) {
    throw BadCall(
        "create: distributed is 1, but MPI is not running in this process; call MPI_Init before, or set distributed = 0");
  }
  const MPI_Comm communicator = MPI_Comm_f2c(arguments.communicator);
  if (communicator == MPI_COMM_NULL) {
    throw BadCall(
        fmt::format("create: communicator {} is no handle of this MPI; give MPI_Comm_c2f(comm)", arguments.communicator));
  }
  return std::make_unique<MpiCommunicator>(communicator);
}

SolverSettings ReadSettings(const nscdd_create_arguments& arguments) {
  if (arguments.solver == nullptr) throw BadCall("create: the name of the solver is null");
  const SolverEntry& solver = FindSolver(arguments.solver);
  if (arguments.option_count > kMostOptions) {
    throw Error(fmt::format("create: {} options, at most {} are read", arguments.option_count, kMostOptions));
  }
  if (arguments.option_count > 0 && (arguments.option_names == nullptr || arguments.option_values == nullptr)) {
    throw BadCall(fmt::format("create: {} options, but option_names or option_values is null", arguments.option_count));
  }
  OptionTexts texts;
  for (std::uint64_t i = 0; i < arguments.option_count; ++i) {
    const char* name = arguments.option_names[i];
    const char* value = arguments.option_values[i];
    if (name == nullptr || value == nullptr) throw BadCall(fmt::format("create: name or value of option {} is null", i));
    texts.emplace_back(name, value);
  }
  return MakeSettings(solver, texts);
}

/// What this rank asked for, a line each.
std::string WishOf(const nscdd_create_arguments& arguments, const SolverSettings& settings, const CallbackAdapter* adapter) {
  const SolverEntry& solver = FindSolver(arguments.solver);
  std::string wish = fmt::format("solver = {}\n", solver.name);
  if (adapter == nullptr) {
    wish += "host = none\n";
  } else {
    const AdapterDescription d = adapter->Describe();
    wish += fmt::format("host = '{}', period {} m from {} m, clusters {}, prescribed_motion {}\n", d.name, d.period,
                        d.period_origin, d.clusters, d.prescribed_motion);
  }
  for (const Option& option : solver.options)
    wish += fmt::format("{} = {}\n", option.name, TextOf(option, option.get(settings)));
  return wish;
}

/// Ranks that ask for different things would wait for each other for ever.
void CheckSameEverywhere(const std::string& wish, Communicator* communicator) {
  std::vector<std::byte> bytes;
  for (const char c : wish) bytes.push_back(static_cast<std::byte>(c));
  communicator->Broadcast(0, &bytes);
  RunTogether(communicator, [&] {
    std::istringstream mine(wish), first(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    for (std::string here, there; std::getline(mine, here);) {
      std::getline(first, there);
      if (here == there) continue;
      throw Error(fmt::format("create: {} here, but {} on rank 0; give all ranks the same solver, options and kind of host",
                              here, there));
    }
  });
}

}  // namespace

SolverHandle::SolverHandle(const nscdd_create_arguments& arguments) : communicator_(MakeCommunicator(arguments)) {
  RunTogether(communicator_.get(), [&] {
    settings_ = ReadSettings(arguments);
    if (arguments.host != nullptr) adapter_ = std::make_unique<CallbackAdapter>(arguments.host);
  });
  if (communicator_->size() > 1) CheckSameEverywhere(WishOf(arguments, settings_, adapter_.get()), communicator_.get());
  if (adapter_ == nullptr) return;
  stepper_ = std::make_unique<TimeStepper>(settings_.stepping, settings_.algorithm, adapter_.get(), communicator_.get());
}

TimeStepper& SolverHandle::stepper(const char* function) const {
  if (stepper_ != nullptr) return *stepper_;
  throw BadCall(
      fmt::format("{}: this handle was created without a host and only solves single problems; give create a host", function));
}

void SolverHandle::Step(double dt) {
  TimeStepper& stepper = this->stepper("step");
  const bool is_sound = std::isfinite(dt) && dt > 0.0;
  if (is_sound) last_ = Last::kNothing;
  try {
    report_ = stepper.Step(dt);  // refuses dt on all ranks together
  } catch (const Error& e) {
    if (!is_sound) throw;
    throw Failure(e.what());  // the arguments were fine: what failed is the host, the transport or the arithmetic
  }
  last_ = Last::kStep;
}

void SolverHandle::Solve(const nscdd_problem& problem, nscdd_solution* solution) {
  const SingleProblem single = CopyProblem(problem, PartitionOf(settings_.algorithm));
  const ContactTable& contacts = single.problem.contacts;
  if ((solution->velocity == nullptr && !single.problem.mass.empty()) ||
      (solution->impulse == nullptr && contacts.size() > 0)) {
    throw BadCall("solve: velocity or impulse of nscdd_solution is null; give arrays for the answer");
  }
  last_ = Last::kNothing;
  const auto start = std::chrono::steady_clock::now();
  ContactSolution answer = SolveContactProblem(single.problem, settings_.algorithm, single.warm);
  report_ = {};
  report_.seconds_solve = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CopySolution(answer, solution);
  report_.solve = std::move(answer.report);
  for (const double mass : single.problem.mass) report_.bodies += std::isfinite(mass) ? 1 : 0;
  last_ = Last::kSolve;
}

void SolverHandle::Report(nscdd_report* report) const {
  if (last_ == Last::kNothing) throw BadCall("report: there is no finished step or solve to report; call step or solve first");
  CopyReport(report_, report);
}

void SolverHandle::Table(std::string_view name, nscdd_table* table) {
  if (last_ == Last::kNothing) throw BadCall("table: there is no finished step or solve to show; call step or solve first");
  const bool of_step = name == "bodies" || name == "contacts";
  if (!of_step && name != "iterations") {
    throw Error(fmt::format("table: there is no table '{}'; take bodies, contacts or iterations", name.substr(0, 64)));
  }
  if (of_step && last_ != Last::kStep) throw BadCall(fmt::format("table: '{}' is there after a step, not after a solve", name));
  if (name == "bodies") table_.FillBodies(stepper_->bodies());
  if (name == "contacts") table_.FillContacts(stepper_->contacts());
  if (name == "iterations") table_.FillIterations(report_.solve.history);
  table_.Show(table);
}

std::vector<std::byte> SolverHandle::SaveState() const { return stepper("save_state").SaveState(); }

void SolverHandle::LoadState(const void* bytes, std::uint64_t size) {
  TimeStepper& stepper = this->stepper("load_state");
  RunTogether(communicator_.get(), [&] {
    if (bytes == nullptr) throw BadCall("load_state: the pointer to the bytes is null");
  });
  stepper.LoadState({static_cast<const std::byte*>(bytes), static_cast<std::size_t>(size)});
}

void SolverHandle::LoadStates(std::uint64_t count, const void* const* parts, const std::uint64_t* sizes) {
  TimeStepper& stepper = this->stepper("load_states");
  std::vector<std::span<const std::byte>> given;
  RunTogether(communicator_.get(), [&] {
    if (count > 0 && (parts == nullptr || sizes == nullptr)) {
      throw BadCall("load_states: the pointer to the parts or their sizes is null");
    }
    for (std::uint64_t i = 0; i < count; ++i) {
      if (parts[i] == nullptr) throw BadCall(fmt::format("load_states: the pointer to part {} is null", i));
      given.emplace_back(static_cast<const std::byte*>(parts[i]), static_cast<std::size_t>(sizes[i]));
    }
  });
  stepper.LoadState(given);
}

}  // namespace nscdd
