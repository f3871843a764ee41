// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nscdd/contact_problem.h"
#include "nscdd/host/plugin_library.h"
#include "nscdd/report.h"

namespace nscdd {

/// How to make a solver handle.
struct SolverArguments {
  std::string solver;
  std::vector<std::pair<std::string, std::string>> options;  ///< name and value, as text
  const nscdd_host* host = nullptr;          ///< null: single problems only; must outlive the solver (AdapterHost makes one)
  std::optional<std::int32_t> communicator;  ///< MPI_Comm_c2f; none: this process alone, MPI is not touched
};

/// A column of a solver's table: one of the two spans has the rows.
struct TableColumn {
  std::string name;
  std::string unit;
  std::span<const std::int64_t> integer;
  std::span<const double> real;
};

/// View of a table of the last step or solve, valid until the next call on the solver.
class TableView {
 public:
  TableView(std::string name, const nscdd_table& table);
  std::size_t rows() const { return rows_; }
  const std::vector<TableColumn>& columns() const { return columns_; }
  /// Throws Error if there is no such column or it has the other type.
  std::span<const std::int64_t> Integer(const std::string& column) const;
  std::span<const double> Real(const std::string& column) const;

 private:
  const TableColumn& Find(const std::string& column) const;
  std::string name_;
  std::size_t rows_;
  std::vector<TableColumn> columns_;
};

/// One handle of a plugin's solver. Errors of the plugin become Error with its sentence. Not for concurrent use.
class Solver {
 public:
  /// Collective when a communicator is given. Throws Error when the plugin refuses.
  Solver(std::shared_ptr<const PluginLibrary> library, const SolverArguments& arguments);

  /// One step of dt [s]; collective.
  void Step(double dt);
  /// One contact problem, contacts kept in their order. problem.subdomain must be empty: the plugin places contacts by their
  /// sites. The report's history is filled.
  ContactSolution Solve(const ContactProblem& problem, const std::vector<Vec2>& warm = {});

  /// Of the last step or solve; solve.history is left empty, see Table("iterations").
  StepReport Report() const;
  TableView Table(const std::string& name) const;

  std::vector<std::byte> SaveState() const;
  void LoadState(std::span<const std::byte> bytes);
  /// On any number of ranks: the parts that all ranks saved, each given to one rank; maybe none here. Collective. Throws Error
  /// also when the plugin is older than load_states.
  void LoadStates(std::span<const std::span<const std::byte>> parts);

  const nscdd_solver_info& info() const { return *info_; }

 private:
  struct Destroy {
    const nscdd_plugin* plugin;
    void operator()(nscdd_solver* handle) const { plugin->destroy(handle); }
  };
  void Check(const char* function, std::int32_t result) const;

  std::shared_ptr<const PluginLibrary> library_;  // first member: unloaded after the handle is gone
  const nscdd_solver_info* info_ = nullptr;
  std::unique_ptr<nscdd_host> older_host_;  // the host's table as a plugin of an earlier minor knows it
  std::unique_ptr<nscdd_solver, Destroy> handle_;
};

/// Asks the plugin whether a solver takes a value of an option. Throws Error with its sentence if not. A plugin older than
/// check_option (ABI minor 3) is asked by making a handle.
void CheckOption(const std::shared_ptr<const PluginLibrary>& library, const std::string& solver, const std::string& option,
                 const std::string& value);

}  // namespace nscdd
