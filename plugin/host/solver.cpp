// SPDX-License-Identifier: Apache-2.0
#include "nscdd/host/solver.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

#include "layout.h"
#include "nscdd/error.h"

namespace nscdd {
namespace {

using Sentence = std::array<char, 4096>;

[[noreturn]] void ThrowSentence(const PluginLibrary& library, const char* function, std::int32_t result, Sentence* sentence) {
  sentence->back() = '\0';
  if (sentence->front() != '\0') throw Error(sentence->data());
  throw Error(fmt::format("plugin '{}': {} failed without a sentence (result {})", library.path(), function, result));
}

StepReport Translate(const nscdd_report& source) {
  StepReport report;
  const auto copy = [](const Figure&, auto& to, const auto& from) {
    using To = std::decay_t<decltype(to)>;
    if constexpr (std::is_same_v<To, std::string>) {
      if (from != nullptr) to = from;
    } else {
      to = static_cast<To>(from);
    }
  };
  ForEachFigure(copy, report, source);
  const bool is_known = source.status >= 0 && static_cast<std::size_t>(source.status) < kStatuses.size();
  if (!is_known) report.solve.status = SolveStatus::kDiverged;  // so that it is not taken for success
  return report;
}

const nscdd_solver_info* FindInfo(const PluginLibrary& library, const std::string& name) {
  const nscdd_solver_info* info = library.FindSolver(name);
  if (info != nullptr) return info;
  std::vector<std::string> names;
  for (std::uint64_t i = 0; i < library.plugin().solver_count; ++i) names.emplace_back(library.plugin().solvers[i].name);
  throw Error(fmt::format("plugin '{}' has no solver '{}'; it has {}", library.path(), name, fmt::join(names, ", ")));
}

std::vector<IterationRecord> History(const TableView& table) {
  std::vector<IterationRecord> history(table.rows());
  const auto iteration = table.Integer("iteration");
  const auto nat = table.Real("nat"), nat_max = table.Real("nat_max");
  const auto qm16 = table.Real("qm16"), jump = table.Real("interface_jump");
  for (std::size_t i = 0; i < history.size(); ++i) {
    history[i] = {static_cast<int>(iteration[i]), nat[i], nat_max[i], qm16[i], jump[i]};
  }
  return history;
}

void CheckSizes(const ContactProblem& p, const std::vector<Vec2>& warm) {
  const std::size_t bodies = p.mass.size(), contacts = p.contacts.size();
  const bool right = p.inertia.size() == bodies && p.free_velocity.size() == bodies && p.impulse.size() == bodies &&
                     p.offset.size() == contacts && (warm.empty() || warm.size() == contacts);
  if (!right) throw Error("contact problem: the columns of bodies or contacts differ in length; fill one entry per row");
  if (!p.subdomain.empty()) throw Error("contact problem: leave `subdomain` empty; the solver places contacts by their sites");
}

}  // namespace

TableView::TableView(std::string name, const nscdd_table& table) : name_(std::move(name)), rows_(table.row_count) {
  for (std::uint64_t i = 0; i < table.column_count; ++i) {
    const nscdd_column& column = table.columns[i];
    TableColumn& view = columns_.emplace_back(TableColumn{column.name, column.unit, {}, {}});
    if (column.is_integer != 0) {
      view.integer = {static_cast<const std::int64_t*>(column.values), rows_};
    } else {
      view.real = {static_cast<const double*>(column.values), rows_};
    }
  }
}

const TableColumn& TableView::Find(const std::string& column) const {
  for (const TableColumn& c : columns_) {
    if (c.name == column) return c;
  }
  throw Error(fmt::format("table '{}' has no column '{}'; load the plugin that this program was built with", name_, column));
}

std::span<const std::int64_t> TableView::Integer(const std::string& column) const {
  const TableColumn& c = Find(column);
  if (c.integer.size() != rows_) throw Error(fmt::format("table '{}': column '{}' is real, not integer", name_, column));
  return c.integer;
}

std::span<const double> TableView::Real(const std::string& column) const {
  const TableColumn& c = Find(column);
  if (c.real.size() != rows_) throw Error(fmt::format("table '{}': column '{}' is integer, not real", name_, column));
  return c.real;
}

Solver::Solver(std::shared_ptr<const PluginLibrary> library, const SolverArguments& arguments)
    : library_(std::move(library)),
      info_(FindInfo(*library_, arguments.solver)),
      handle_(nullptr, Destroy{&library_->plugin()}) {
  std::vector<const char*> names, values;
  for (const auto& [name, value] : arguments.options) {
    names.push_back(name.c_str());
    values.push_back(value.c_str());
  }
  auto create = WithHeader<nscdd_create_arguments>();
  create.host = arguments.host;
  if (const std::uint32_t minor = library_->plugin().header.abi_minor;
      create.host != nullptr && create.host->header.abi_minor > minor) {
    // An older plugin does not look at what is new; the host may be older than this header, and smaller.
    older_host_ = std::make_unique<nscdd_host>();
    std::memcpy(older_host_.get(), create.host, std::min<std::size_t>(sizeof(nscdd_host), create.host->header.struct_size));
    older_host_->header.abi_minor = minor;
    create.host = older_host_.get();
  }
  create.distributed = arguments.communicator ? 1 : 0;
  create.communicator = arguments.communicator.value_or(0);
  create.solver = arguments.solver.c_str();
  create.option_count = names.size();
  create.option_names = names.data();
  create.option_values = values.data();
  Sentence sentence{};
  nscdd_solver* handle = nullptr;
  const std::int32_t result = library_->plugin().create(&create, &handle, sentence.data(), sentence.size());
  handle_.reset(handle);
  if (result == NSCDD_OK && handle != nullptr) return;
  ThrowSentence(*library_, "create", result, &sentence);
}

void CheckOption(const std::shared_ptr<const PluginLibrary>& library, const std::string& solver, const std::string& option,
                 const std::string& value) {
  if (library->plugin().header.abi_minor < 3) {
    const Solver asked(library, {.solver = solver, .options = {{option, value}}, .host = nullptr, .communicator = {}});
    return;
  }
  Sentence sentence{};
  const std::int32_t result =
      library->plugin().check_option(solver.c_str(), option.c_str(), value.c_str(), sentence.data(), sentence.size());
  if (result != NSCDD_OK) ThrowSentence(*library, "check_option", result, &sentence);
}

void Solver::Check(const char* function, std::int32_t result) const {
  if (result == NSCDD_OK) return;
  const char* sentence = library_->plugin().last_error(handle_.get());
  if (sentence != nullptr && *sentence != '\0') throw Error(sentence);
  throw Error(fmt::format("plugin '{}': {} failed without a sentence (result {})", library_->path(), function, result));
}

void Solver::Step(double dt) { Check("step", library_->plugin().step(handle_.get(), dt)); }

ContactSolution Solver::Solve(const ContactProblem& problem, const std::vector<Vec2>& warm) {
  CheckSizes(problem, warm);
  auto given = WithHeader<nscdd_problem>();
  given.body_count = problem.mass.size();
  given.mass = problem.mass.data();
  given.inertia = problem.inertia.data();
  given.free_velocity = AsDoubles(problem.free_velocity.data());
  given.impulse = AsDoubles(problem.impulse.data());
  given.contacts = ShowContacts(problem.contacts);
  given.offset = problem.offset.data();
  given.warm_impulse = warm.empty() ? nullptr : AsDoubles(warm.data());
  given.approach_speed = problem.approach_speed;
  ContactSolution solution;
  solution.velocity.resize(problem.mass.size());
  solution.impulse.resize(problem.contacts.size());
  solution.relative_velocity.resize(problem.contacts.size());
  auto target = WithHeader<nscdd_solution>();
  target.velocity = AsDoubles(solution.velocity.data());
  target.impulse = AsDoubles(solution.impulse.data());
  target.relative_velocity = AsDoubles(solution.relative_velocity.data());
  Check("solve", library_->plugin().solve(handle_.get(), &given, &target));
  solution.report = Report().solve;
  solution.report.history = History(Table("iterations"));
  return solution;
}

StepReport Solver::Report() const {
  auto report = WithHeader<nscdd_report>();
  // Says which statuses are known here; an older plugin would refuse a newer minor than its own.
  report.header.abi_minor = std::min(library_->plugin().header.abi_minor, NSCDD_ABI_MINOR);
  Check("report", library_->plugin().report(handle_.get(), &report));
  return Translate(report);
}

TableView Solver::Table(const std::string& name) const {
  auto table = WithHeader<nscdd_table>();
  Check("table", library_->plugin().table(handle_.get(), name.c_str(), &table));
  return TableView(name, table);
}

std::vector<std::byte> Solver::SaveState() const {
  std::uint64_t size = 0;
  Check("state_size", library_->plugin().state_size(handle_.get(), &size));
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  Check("save_state", library_->plugin().save_state(handle_.get(), bytes.data(), size));
  return bytes;
}

void Solver::LoadState(std::span<const std::byte> bytes) {
  Check("load_state", library_->plugin().load_state(handle_.get(), bytes.data(), bytes.size()));
}

void Solver::LoadStates(std::span<const std::span<const std::byte>> parts) {
  library_->RequireLoadStates();
  std::vector<const void*> bytes;
  std::vector<std::uint64_t> sizes;
  for (const auto part : parts) {
    bytes.push_back(part.data());
    sizes.push_back(part.size());
  }
  Check("load_states", library_->plugin().load_states(handle_.get(), parts.size(), bytes.data(), sizes.data()));
}

}  // namespace nscdd
