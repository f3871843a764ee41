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

constexpr Range kPositiveCount{1, 2147483647};
constexpr Range kNotNegative{0.0, 1e308};

std::vector<Option> StoppingTable() {
  return {
      Real(
          "tolerance", "-", [](SolverSettings& s) -> double& { return Stopping(s).tolerance; }, kNotNegative,
          "the iteration stops when the criterion falls below it; 0: only at max_iterations"),
      Choice<Criterion>(
          "criterion", [](SolverSettings& s) -> Criterion& { return Stopping(s).criterion; },
          {"nat", "nat_max", "quad", "maxm", "qm16"},
          "what is tested: natural residual (relative; worst contact), or LMGC90's Quad, Maxm, QM/16"),
      Integer(
          "max_iterations", [](SolverSettings& s) -> int& { return Stopping(s).max_iterations; }, kPositiveCount,
          "limit of sweeps (one subdomain) or interface updates"),
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

std::vector<Option> DecompositionOptions() {
  return {
      Grid("subdomains", Partition, "grid of subdomains over the mobile bodies, such as 4x2"),
      Integer(
          "repartition_every", [](SolverSettings& s) -> int& { return Partition(s).repartition_every; }, kPositiveCount,
          "steps between two placements of the grid"),
      Integer("sweeps_per_stage", SweepsPerStage, kPositiveCount, "sweeps of each subdomain between two interface updates"),
  };
}

}  // namespace nscdd
