// SPDX-License-Identifier: Apache-2.0
#include "option_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "option_text.h"

namespace nscdd {
namespace {

// Where an option lives in the settings.
template <class T>
using Member = T& (*)(SolverSettings&);

template <class T>
const T& Read(Member<T> member, const SolverSettings& settings) {
  return member(const_cast<SolverSettings&>(settings));  // the accessors only navigate
}

Option Real(const char* name, const char* unit, Member<double> member, Range range, const char* help) {
  return {name,
          NSCDD_REAL,
          unit,
          "",
          help,
          [=](std::string_view text, SolverSettings* s) { member(*s) = ParseReal(name, text, range); },
          [=](const SolverSettings& s) { return fmt::format("{}", Read(member, s)); }};
}

Option Integer(const char* name, Member<int> member, Range range, const char* help) {
  return {name,
          NSCDD_INTEGER,
          "-",
          "",
          help,
          [=](std::string_view text, SolverSettings* s) { member(*s) = ParseInteger(name, text, range); },
          [=](const SolverSettings& s) { return fmt::format("{}", Read(member, s)); }};
}

Option Bool(const char* name, Member<bool> member, const char* help) {
  return {name,
          NSCDD_BOOL,
          "-",
          "",
          help,
          [=](std::string_view text, SolverSettings* s) { member(*s) = ParseBool(name, text); },
          [=](const SolverSettings& s) { return fmt::format("{}", Read(member, s)); }};
}

// `names` in the order of the enumerators, which count from 0.
template <class Enum>
Option Choice(const char* name, Member<Enum> member, const std::vector<std::string>& names, const char* help) {
  return {name,
          NSCDD_CHOICE,
          "-",
          fmt::format("{}", fmt::join(names, "|")),
          help,
          [=](std::string_view text, SolverSettings* s) { member(*s) = static_cast<Enum>(ParseChoice(name, text, names)); },
          [=](const SolverSettings& s) { return names.at(static_cast<std::size_t>(Read(member, s))); }};
}

Option Grid(const char* name, Member<PartitionOptions> member, const char* help) {
  return {name,
          NSCDD_GRID,
          "-",
          "",
          help,
          [=](std::string_view text, SolverSettings* s) { ParseGrid(name, text, &member(*s)); },
          [=](const SolverSettings& s) { return fmt::format("{}x{}", Read(member, s).nx, Read(member, s).ny); }};
}

StoppingOptions& Stopping(SolverSettings& s) {
  return std::visit([](auto& algorithm) -> StoppingOptions& { return algorithm.stopping; }, s.algorithm);
}

// Of the alternatives that have a partition; the others have no option that asks for it.
PartitionOptions& Partition(SolverSettings& s) {
  return std::visit(
      [](auto& algorithm) -> PartitionOptions& {
        if constexpr (requires { algorithm.partition; }) return algorithm.partition;
        throw std::logic_error("this solver has no partition");
      },
      s.algorithm);
}

int& SweepsPerStage(SolverSettings& s) {
  return std::visit(
      [](auto& algorithm) -> int& {
        if constexpr (requires { algorithm.sweeps_per_stage; }) return algorithm.sweeps_per_stage;
        throw std::logic_error("this solver has no stages");
      },
      s.algorithm);
}

AccelerationOptions& Accelerated(SolverSettings& s) {
  return std::visit(
      [](auto& algorithm) -> AccelerationOptions& {
        if constexpr (requires { algorithm.acceleration; }) return algorithm.acceleration;
        throw std::logic_error("this solver has no acceleration");
      },
      s.algorithm);
}

AugmentedInterfaceOptions& Interface(SolverSettings& s) {
  return std::visit(
      [](auto& algorithm) -> AugmentedInterfaceOptions& {
        if constexpr (requires { algorithm.interface; }) return algorithm.interface;
        throw std::logic_error("this solver has no augmented interface");
      },
      s.algorithm);
}

constexpr Range kPositiveCount{1, 2147483647};
constexpr Range kNotNegative{0.0, 1e308};

std::vector<Option> StoppingTable() {
  return {
      Real(
          "tolerance", "-", [](SolverSettings& s) -> double& { return Stopping(s).tolerance; }, kNotNegative,
          "the iteration stops when the criterion falls below it; 0: it makes max_iterations iterations, status fixed"),
      Choice<Criterion>(
          "criterion", [](SolverSettings& s) -> Criterion& { return Stopping(s).criterion; },
          {"nat", "nat_max", "quad", "maxm", "qm16"},
          "what is tested: natural residual (relative; worst contact), or LMGC90's Quad, Maxm, QM/16"),
      Integer(
          "max_iterations", [](SolverSettings& s) -> int& { return Stopping(s).max_iterations; }, kPositiveCount,
          "limit of sweeps (nscd), interface updates, or factorisations (newton)"),
      Integer(
          "test_every", [](SolverSettings& s) -> int& { return Stopping(s).test_every; }, kPositiveCount,
          "iterations between two tests of the criterion; a test costs about one sweep"),
      Integer(
          "stall_iterations", [](SolverSettings& s) -> int& { return Stopping(s).stall_iterations; }, kPositiveCount,
          "iterations without a new minimum of the residual after which the status is 'stalled'"),
  };
}

std::vector<Option> SteppingTable() {
  return {
      Real(
          "theta", "-", [](SolverSettings& s) -> double& { return s.stepping.theta; }, Range{0.5, 1.0},
          "of the Moreau-Jean scheme: contacts are detected at q + (1 - theta) dt V"),
      Real(
          "alert_distance", "m", [](SolverSettings& s) -> double& { return s.stepping.alert_distance; }, Range{},
          "pairs with a larger gap are no candidates; negative: a tenth of the mean radius"),
      Choice<NormalLaw>(
          "normal_law", [](SolverSettings& s) -> NormalLaw& { return s.stepping.normal_law; }, {"gap", "strict", "feedback"},
          "offset of the normal law: max(0, gap) / dt; touching contacts only; with recovery of interpenetration"),
      Real(
          "feedback_beta", "-", [](SolverSettings& s) -> double& { return s.stepping.feedback_beta; }, Range{0.0, 1.0},
          "part of the interpenetration that one step undoes, normal_law = feedback"),
      Real(
          "feedback_slop", "m", [](SolverSettings& s) -> double& { return s.stepping.feedback_slop; }, kNotNegative,
          "interpenetration that is left alone, normal_law = feedback"),
      Real(
          "feedback_cap", "m/s", [](SolverSettings& s) -> double& { return s.stepping.feedback_cap; }, kNotNegative,
          "largest recovery speed, normal_law = feedback"),
      Bool(
          "warm_start", [](SolverSettings& s) -> bool& { return s.stepping.warm_start; },
          "start from the impulses of the previous step"),
  };
}

}  // namespace

std::vector<Option> CommonOptions() {
  std::vector<Option> options = StoppingTable();
  for (Option& option : SteppingTable()) options.push_back(std::move(option));
  return options;
}

std::vector<Option> PartitionOptionTable() {
  return {
      Grid("subdomains", Partition, "grid of subdomains over the mobile bodies, such as 4x2"),
      Integer(
          "repartition_every", [](SolverSettings& s) -> int& { return Partition(s).repartition_every; }, kPositiveCount,
          "steps between two placements of the grid"),
  };
}

std::vector<Option> AccelerationTable() {
  return {
      Choice<Acceleration>(
          "acceleration", [](SolverSettings& s) -> Acceleration& { return Accelerated(s).method; }, {"none", "anderson"},
          "of the iteration; none is that of the paper"),
      Integer(
          "anderson_depth", [](SolverSettings& s) -> int& { return Accelerated(s).depth; }, Range{1, 8},
          "earlier iterates that are combined with the last"),
      Integer(
          "anderson_every", [](SolverSettings& s) -> int& { return Accelerated(s).every; }, kPositiveCount,
          "iterations between two extrapolations"),
  };
}

std::vector<Option> StageOptions() {
  return {
      Integer("sweeps_per_stage", SweepsPerStage, kPositiveCount, "sweeps of each subdomain between two interface updates")};
}

std::vector<Option> InterfaceOptions() {
  return {
      Real(
          "lambda", "-", [](SolverSettings& s) -> double& { return Interface(s).lambda; }, Range{0.0, 1e8},
          "search direction over the reference mass; 0: the plain interface of nscdd"),
      Choice<Compatibility>(
          "compatibility", [](SolverSettings& s) -> Compatibility& { return Interface(s).compatibility; },
          {"normal", "full", "sticking"},
          "active contacts in the interface problem: normals; and tangents; and tangents of sticking ones"),
      Choice<StatusCompatibility>(
          "status_compatibility", [](SolverSettings& s) -> StatusCompatibility& { return Interface(s).status_compatibility; },
          {"same", "normal", "sticking"}, "contacts whose velocity enters the right-hand side, if other than in the matrix"),
      Choice<LocalVelocity>(
          "local_velocity", [](SolverSettings& s) -> LocalVelocity& { return Interface(s).local_velocity; },
          {"local", "current"}, "velocity in the search direction: what each local solve left, or that of now"),
      Choice<LambdaScale>(
          "lambda_scale", [](SolverSettings& s) -> LambdaScale& { return Interface(s).lambda_scale; }, {"mass", "contact"},
          "what lambda multiplies: the reference mass, or 1 / W_nn of each contact"),
      Real(
          "reference_mass", "kg", [](SolverSettings& s) -> double& { return Interface(s).reference_mass; }, kNotNegative,
          "0: mean mass of the free bodies"),
      Real(
          "restoring", "-", [](SolverSettings& s) -> double& { return Interface(s).restoring; }, Range{0.0, 1.0},
          "part of the interpenetration that the interface problem alone undoes in a step"),
      Choice<InterfaceSolve>(
          "interface", [](SolverSettings& s) -> InterfaceSolve& { return Interface(s).solve; }, {"direct", "cg"},
          "assembled and factorised, or by the conjugate gradient among neighbours"),
      Choice<LinearLibrary>(
          "linear_solver", [](SolverSettings& s) -> LinearLibrary& { return Interface(s).linear_solver; },
          {"auto", "eigen", "mumps"}, "auto is eigen; mumps needs mpirun"),
      Choice<Preconditioner>(
          "preconditioner", [](SolverSettings& s) -> Preconditioner& { return Interface(s).preconditioner; },
          {"none", "diagonal", "lumped", "dirichlet"}, "of interface = cg"),
      Real(
          "cg_tolerance", "-", [](SolverSettings& s) -> double& { return Interface(s).cg_tolerance; }, Range{1e-15, 0.999},
          "fall of the jump in one update by interface = cg"),
      Integer(
          "cg_max_iterations", [](SolverSettings& s) -> int& { return Interface(s).cg_max_iterations; }, kPositiveCount,
          "of one update by interface = cg"),
  };
}

std::vector<Option> FeaOptionTable() {
  return {Bool(
      "jump_guard", [](SolverSettings& s) -> bool& { return std::get<FeaOptions>(s.algorithm).jump_guard; },
      "plain updates for a while where the jump of the copies has more than doubled")};
}

std::vector<Option> NewtonOptionTable() {
  return {
      Choice<LinearLibrary>(
          "linear_solver",
          [](SolverSettings& s) -> LinearLibrary& { return std::get<NewtonOptions>(s.algorithm).linear_solver; },
          {"auto", "eigen", "mumps"}, "auto is our block LU; mumps needs mpirun"),
  };
}

std::vector<Option> ReaOptionTable() {
  return {Integer(
      "max_interface_updates",
      [](SolverSettings& s) -> int& { return std::get<ReaOptions>(s.algorithm).max_interface_updates; }, kPositiveCount,
      "interface updates before the subdomains are solved by themselves")};
}

std::vector<Option> IeaOptionTable() {
  return {
      Integer(
          "polish_sweeps", [](SolverSettings& s) -> int& { return std::get<IeaOptions>(s.algorithm).polish_sweeps; },
          Range{0, 2147483647}, "closing sweeps of the contacts of interface bodies"),
      Integer(
          "closing_updates", [](SolverSettings& s) -> int& { return std::get<IeaOptions>(s.algorithm).closing_updates; },
          Range{0, 2147483647}, "closing iterations of nscdd (hybrid)"),
  };
}

}  // namespace nscdd
