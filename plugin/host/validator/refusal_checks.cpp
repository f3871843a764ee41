// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "layout.h"
#include "nscdd/host/solver.h"
#include "validator/check_list.h"
#include "validator/two_disk_host.h"

namespace nscdd {
namespace {

constexpr double kTimeStep = 0.05;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A handle through the bare C functions, as a careless host would use them.
class RawHandle {
 public:
  RawHandle(const PluginLibrary& library, const std::string& name, const nscdd_host* host) : plugin_(library.plugin()) {
    auto arguments = WithHeader<nscdd_create_arguments>();
    arguments.solver = name.c_str();
    arguments.host = host;
    std::array<char, 1024> error{};
    Expect(plugin_.create(&arguments, &handle_, error.data(), error.size()) == NSCDD_OK && handle_ != nullptr,
           fmt::format("create failed: {}", error.data()));
  }
  ~RawHandle() { plugin_.destroy(handle_); }
  RawHandle(const RawHandle&) = delete;
  RawHandle& operator=(const RawHandle&) = delete;
  nscdd_solver* get() const { return handle_; }

  // `result` must be a refusal, and its sentence must be there.
  void ExpectRefused(std::int32_t result, const std::string& what) const {
    Expect(result != NSCDD_OK, fmt::format("{} was accepted; refuse it", what));
    const char* sentence = plugin_.last_error(handle_);
    Expect(sentence != nullptr && *sentence != '\0', fmt::format("{} was refused without a sentence in last_error", what));
  }

 private:
  const nscdd_plugin& plugin_;
  nscdd_solver* handle_ = nullptr;
};

void ExpectCreateRefused(const PluginLibrary& library, const nscdd_create_arguments* arguments, const std::string& what) {
  std::array<char, 1024> error{};
  nscdd_solver* handle = nullptr;
  const std::int32_t result = library.plugin().create(arguments, &handle, error.data(), error.size());
  if (handle != nullptr) library.plugin().destroy(handle);
  Expect(result != NSCDD_OK && handle == nullptr, fmt::format("create accepted {}; refuse it and give no handle", what));
  Expect(error[0] != '\0' && std::memchr(error.data(), 0, error.size()) != nullptr,
         fmt::format("create refused {} without a terminated sentence", what));
}

/// By a plugin that has check_option.
void ExpectOptionRefused(const PluginLibrary& library, const char* solver, const char* option, const char* value,
                         const std::string& what) {
  if (library.plugin().header.abi_minor < 3) return;
  std::array<char, 1024> error{};
  const std::int32_t result = library.plugin().check_option(solver, option, value, error.data(), error.size());
  Expect(result != NSCDD_OK, fmt::format("check_option accepted {}; refuse it", what));
  Expect(error[0] != '\0' && std::memchr(error.data(), 0, error.size()) != nullptr,
         fmt::format("check_option refused {} without a terminated sentence", what));
}

nscdd_create_arguments Arguments(const char* solver) {
  auto arguments = WithHeader<nscdd_create_arguments>();
  arguments.solver = solver;
  return arguments;
}

void UnknownNames(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const nscdd_create_arguments unknown = Arguments("no_such_solver");
  ExpectCreateRefused(*library, &unknown, "a solver that does not exist");
  ForEachSolver(*library, [&](const std::string& name) {
    const char* option = "no_such_option";
    const char* value = "1";
    nscdd_create_arguments arguments = Arguments(name.c_str());
    arguments.option_count = 1;
    arguments.option_names = &option;
    arguments.option_values = &value;
    ExpectCreateRefused(*library, &arguments, "an option that does not exist");
    ExpectOptionRefused(*library, "no_such_solver", option, value, "a solver that does not exist");
    ExpectOptionRefused(*library, name.c_str(), option, value, "an option that does not exist");
    const nscdd_solver_info& info = *library->FindSolver(name);
    value = "no_such_value";
    for (std::uint64_t i = 0; i < info.option_count; ++i) {
      option = info.options[i].name;
      ExpectCreateRefused(*library, &arguments, fmt::format("{} = no_such_value", option));
      ExpectOptionRefused(*library, name.c_str(), option, value, fmt::format("{} = no_such_value", option));
    }
  });
}

void NullPointers(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const nscdd_plugin& p = library->plugin();
  ExpectCreateRefused(*library, nullptr, "null arguments");
  p.destroy(nullptr);
  std::uint64_t size = 0;
  Expect(p.step(nullptr, kTimeStep) != NSCDD_OK && p.state_size(nullptr, &size) != NSCDD_OK,
         "a null handle was accepted; refuse it");
  Expect(p.last_error(nullptr) != nullptr, "last_error of a null handle is null; give a sentence");
  ForEachSolver(*library, [&](const std::string& name) {
    nscdd_create_arguments arguments = Arguments(name.c_str());
    arguments.solver = nullptr;
    ExpectCreateRefused(*library, &arguments, "a null solver name");
    ExpectOptionRefused(*library, nullptr, "a", "1", "a null solver name");
    ExpectOptionRefused(*library, name.c_str(), nullptr, "1", "a null option name");
    ExpectOptionRefused(*library, name.c_str(), "a", nullptr, "a null value");
    arguments = Arguments(name.c_str());
    arguments.option_count = 1;
    ExpectCreateRefused(*library, &arguments, "one option and null arrays of them");
    arguments = Arguments(name.c_str());
    Expect(p.create(&arguments, nullptr, nullptr, 0) != NSCDD_OK, "create accepted a null place for the handle; refuse it");
    TwoDiskHost host;
    const RawHandle handle(*library, name, host.table());
    auto problem = WithHeader<nscdd_problem>();
    auto solution = WithHeader<nscdd_solution>();
    auto table = WithHeader<nscdd_table>();
    handle.ExpectRefused(p.solve(handle.get(), nullptr, &solution), "a null problem");
    handle.ExpectRefused(p.solve(handle.get(), &problem, nullptr), "a null solution");
    problem.body_count = 1;
    handle.ExpectRefused(p.solve(handle.get(), &problem, &solution), "a problem with one body and null arrays");
    handle.ExpectRefused(p.step(handle.get(), kTimeStep) == NSCDD_OK ? p.report(handle.get(), nullptr) : NSCDD_OK,
                         "a null report");
    handle.ExpectRefused(p.table(handle.get(), nullptr, &table), "a null table name");
    handle.ExpectRefused(p.table(handle.get(), "bodies", nullptr), "a null table");
    handle.ExpectRefused(p.table(handle.get(), "no_such_table", &table), "a table that does not exist");
    handle.ExpectRefused(p.state_size(handle.get(), nullptr), "a null state size");
    handle.ExpectRefused(p.load_state(handle.get(), nullptr, 8), "a null state");
  });
}

void TruncatedStructures(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const nscdd_plugin& p = library->plugin();
  ForEachSolver(*library, [&](const std::string& name) {
    nscdd_create_arguments arguments = Arguments(name.c_str());
    arguments.header.struct_size = sizeof(nscdd_header);
    ExpectCreateRefused(*library, &arguments, "truncated arguments");
    arguments = Arguments(name.c_str());
    arguments.header.abi_major = NSCDD_ABI_MAJOR + 1;
    ExpectCreateRefused(*library, &arguments, "arguments of another ABI major");
    TwoDiskHost host;
    nscdd_host truncated = *host.table();
    truncated.header.struct_size = sizeof(nscdd_header);
    arguments = Arguments(name.c_str());
    arguments.host = &truncated;
    ExpectCreateRefused(*library, &arguments, "a truncated host");
    truncated = *host.table();
    truncated.read_bodies = nullptr;
    ExpectCreateRefused(*library, &arguments, "a host without read_bodies");
    const RawHandle handle(*library, name, host.table());
    Expect(p.step(handle.get(), kTimeStep) == NSCDD_OK, "the step of two disks failed");
    auto report = WithHeader<nscdd_report>();
    report.header.struct_size = sizeof(nscdd_header);
    handle.ExpectRefused(p.report(handle.get(), &report), "a truncated report");
    auto table = WithHeader<nscdd_table>();
    table.header.struct_size = sizeof(nscdd_header);
    handle.ExpectRefused(p.table(handle.get(), "bodies", &table), "a truncated table");
  });
}

void TerminatedSentences(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const nscdd_create_arguments arguments = Arguments("no_such_solver");
  for (const std::uint64_t size : {0, 1, 8, 64}) {
    std::array<char, 128> error;
    error.fill('~');
    nscdd_solver* handle = nullptr;
    library->plugin().create(&arguments, &handle, error.data(), size);
    Expect(handle == nullptr, "create gave a handle of a solver that does not exist");
    Expect(size == 0 || std::memchr(error.data(), 0, size) != nullptr,
           fmt::format("the sentence of create is not terminated within {} bytes; cut it and terminate it", size));
    Expect(error[size] == '~', fmt::format("create wrote behind the {} bytes of the sentence; cut it", size));
  }
  nscdd_solver* handle = nullptr;
  library->plugin().create(&arguments, &handle, nullptr, 100);
}

void HostFailures(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const nscdd_plugin& p = library->plugin();
  constexpr const char* kSentence = "the tide is too high today";
  ForEachSolver(*library, [&](const std::string& name) {
    for (const char* function : {"read_bodies", "detect_contacts", "commit"}) {
      TwoDiskHost host;
      const RawHandle handle(*library, name, host.table());
      const auto before = host.pose();
      host.FailIn(function, kSentence);
      const std::int32_t result = p.step(handle.get(), kTimeStep);
      handle.ExpectRefused(result, fmt::format("a host whose {} fails", function));
      Expect(std::string(p.last_error(handle.get())).find(kSentence) != std::string::npos,
             fmt::format("the host's sentence on {} is lost; last_error says: {}", function, p.last_error(handle.get())));
      Expect(host.pose() == before, fmt::format("the host was changed though its {} failed", function));
      host.FailIn("", "");
      Expect(p.step(handle.get(), kTimeStep) == NSCDD_OK,
             fmt::format("after a failure of {} the handle is of no use: {}", function, p.last_error(handle.get())));
    }
  });
}

// A disk on a plane with one number spoilt.
void ExpectProblemRefused(const PluginLibrary& library, const RawHandle& handle, int spoilt, const char* what) {
  std::array<double, 2> mass{std::numeric_limits<double>::infinity(), 1.0}, inertia = mass;
  std::array<double, 6> velocity{0.0, 0.0, 0.0, 0.0, -1.0, 0.0}, impulse{}, answer{};
  const std::int32_t a = 0, b = 1;
  std::array<double, 2> normal{0.0, 1.0}, site{}, reaction{};
  double gap = 0.0, lever_a = 0.0, lever_b = 0.5, friction = 0.3, restitution = 0.0, offset = 0.0;
  const std::uint8_t flat = 1;
  double* numbers[] = {&mass[1], &velocity[4], &impulse[4], &normal[1], &lever_b, &friction, &offset, &gap};
  *numbers[spoilt] = kNan;
  auto problem = WithHeader<nscdd_problem>();
  problem.body_count = 2;
  problem.mass = mass.data();
  problem.inertia = inertia.data();
  problem.free_velocity = velocity.data();
  problem.impulse = impulse.data();
  problem.contacts = {1,        &a,       &b,      nullptr, nullptr,     nullptr, &gap,      normal.data(),
                      &lever_a, &lever_b, nullptr, nullptr, site.data(), &flat,   &friction, &restitution};
  problem.offset = &offset;
  auto solution = WithHeader<nscdd_solution>();
  solution.velocity = answer.data();
  solution.impulse = reaction.data();
  handle.ExpectRefused(library.plugin().solve(handle.get(), &problem, &solution),
                       fmt::format("a problem whose {} is NaN", what));
}

void NotANumber(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const nscdd_plugin& p = library->plugin();
  ForEachSolver(*library, [&](const std::string& name) {
    TwoDiskHost host;
    const RawHandle handle(*library, name, host.table());
    const char* numbers[] = {"mass", "free velocity", "impulse", "normal", "lever", "friction", "offset", "gap"};
    for (int i = 0; i < 8; ++i) ExpectProblemRefused(*library, handle, i, numbers[i]);
    for (const double dt : {kNan, 0.0, -kTimeStep, std::numeric_limits<double>::infinity()}) {
      handle.ExpectRefused(p.step(handle.get(), dt), fmt::format("a step of dt = {}", dt));
    }
    host.SetSecondSpeed(kNan);
    handle.ExpectRefused(p.step(handle.get(), kTimeStep), "a host with a velocity that is NaN");
    Expect(host.commits() == 0, "a refused step was committed");
  });
}

void WrongStates(const std::string& path) {
  const auto library = PluginLibrary::Load(path);
  const nscdd_plugin& p = library->plugin();
  ForEachSolver(*library, [&](const std::string& name) {
    TwoDiskHost host;
    const RawHandle handle(*library, name, host.table());
    const std::array<char, 64> garbage{'n', 'o', ' ', 's', 't', 'a', 't', 'e'};
    handle.ExpectRefused(p.load_state(handle.get(), garbage.data(), garbage.size()), "a state of 64 bytes of garbage");
    std::uint64_t size = 0;
    Expect(p.state_size(handle.get(), &size) == NSCDD_OK, "state_size failed");
    std::vector<char> small(static_cast<std::size_t>(size), 0);
    Expect(size > 0, "the state has no bytes; it must at least name itself");
    handle.ExpectRefused(p.save_state(handle.get(), small.data(), size - 1), "a state saved into too few bytes");
    Expect(p.save_state(handle.get(), small.data(), size) == NSCDD_OK, "save_state failed");
    handle.ExpectRefused(p.load_state(handle.get(), small.data(), size - 1), "a truncated state");
    if (p.header.abi_minor >= 1) {
      const std::array<const void*, 2> twice{small.data(), small.data()};
      const std::array<std::uint64_t, 2> sizes{size, size};
      handle.ExpectRefused(p.load_states(handle.get(), 2, twice.data(), sizes.data()), "the same part of a state twice");
      handle.ExpectRefused(p.load_states(handle.get(), 0, nullptr, nullptr), "a state of no parts");
      handle.ExpectRefused(p.load_states(handle.get(), 1, nullptr, nullptr), "null parts of a state");
    }
    const RawHandle without_host(*library, name, nullptr);
    without_host.ExpectRefused(p.step(without_host.get(), kTimeStep), "a step of a handle without a host");
  });
}

}  // namespace

std::vector<Check> RefusalChecks() {
  return {
      {"refuses unknown solvers, options and values", UnknownNames},
      {"refuses null pointers", NullPointers},
      {"refuses truncated structures and other majors", TruncatedStructures},
      {"cuts and terminates its sentences", TerminatedSentences},
      {"passes on the sentence of a failing host", HostFailures},
      {"refuses numbers that are not numbers", NotANumber},
      {"refuses wrong states and steps without a host", WrongStates},
  };
}

}  // namespace nscdd
