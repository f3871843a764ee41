// SPDX-License-Identifier: Apache-2.0
#include "nscdd/option_table.h"

#include <iterator>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace nscdd {
namespace {

// Where an option lives in the settings.
template <class T>
using Member = T& (*)(SolverSettings&);

/// `Part` finds a structure of the settings; the option is its member.
template <auto Part, auto Pointer>
auto& At(SolverSettings& settings) {
  return Part(settings).*Pointer;
}

template <class T>
const T& Read(Member<T> member, const SolverSettings& settings) {
  return member(const_cast<SolverSettings&>(settings));  // the accessors only navigate
}

template <class T>
Option Number(const char* name, const char* unit, Member<T> member, Limits limits, const char* help) {
  return {name,
          unit,
          limits,
          {},
          help,
          [=](const SolverSettings& s) -> OptionValue { return Read(member, s); },
          [=](const OptionValue& value, SolverSettings* s) { member(*s) = std::get<T>(value); }};
}

Option Real(const char* name, const char* unit, Member<double> member, Limits limits, const char* help) {
  return Number(name, unit, member, limits, help);
}

Option Integer(const char* name, Member<int> member, Limits limits, const char* help) {
  return Number(name, "-", member, limits, help);
}

Option Bool(const char* name, Member<bool> member, const char* help) { return Number(name, "-", member, {}, help); }

/// `words` in the order of the enumerators, which count from 0.
template <class Enum>
Option Choice(const char* name, Member<Enum> member, const std::vector<std::string>& words, const char* help) {
  return {
      name,
      "-",
      {},
      words,
      help,
      [=](const SolverSettings& s) -> OptionValue { return WordIndex{static_cast<std::size_t>(Read(member, s))}; },
      [=](const OptionValue& value, SolverSettings* s) { member(*s) = static_cast<Enum>(std::get<WordIndex>(value).index); }};
}

Option Grid(const char* name, Member<PartitionOptions> member, Limits cells, const char* help) {
  return {name,
          "-",
          cells,
          {},
          help,
          [=](const SolverSettings& s) -> OptionValue {
            return GridSize{Read(member, s).nx, Read(member, s).ny};
          },
          [=](const OptionValue& value, SolverSettings* s) {
            const GridSize grid = std::get<GridSize>(value);
            member(*s).nx = grid.nx;
            member(*s).ny = grid.ny;
          }};
}

SteppingOptions& Stepping(SolverSettings& s) { return s.stepping; }

template <class Alternative>
Alternative& Only(SolverSettings& s) {
  return std::get<Alternative>(s.algorithm);
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

constexpr Limits kPositiveCount{1, 2147483647};
constexpr Limits kNotNegative{0.0, 1e308};

std::vector<Option> StoppingTable() {
  return {
      Real("tolerance", "-", At<Stopping, &StoppingOptions::tolerance>, kNotNegative,
           "the iteration stops when the criterion falls below it; 0: it makes max_iterations iterations, status fixed"),
      Choice("criterion", At<Stopping, &StoppingOptions::criterion>, {"nat", "nat_max", "quad", "maxm", "qm16"},
             "what is tested: natural residual (relative; worst contact), or LMGC90's Quad, Maxm, QM/16"),
      Integer("max_iterations", At<Stopping, &StoppingOptions::max_iterations>, kPositiveCount,
              "limit of sweeps (nscd), interface updates, or factorisations (newton)"),
      Integer("test_every", At<Stopping, &StoppingOptions::test_every>, kPositiveCount,
              "iterations between two tests of the criterion; a test costs about one sweep"),
      Integer("stall_iterations", At<Stopping, &StoppingOptions::stall_iterations>, kPositiveCount,
              "iterations without a new minimum of the residual after which the status is 'stalled'"),
  };
}

std::vector<Option> SteppingTable() {
  return {
      Real("theta", "-", At<Stepping, &SteppingOptions::theta>, Limits{0.5, 1.0},
           "of the laws of one stage: contacts are detected at q + (1 - theta) dt V"),
      Real("alert_distance", "m", At<Stepping, &SteppingOptions::alert_distance>, Limits{},
           "pairs with a larger gap are no candidates; negative: a tenth of the mean radius"),
      Choice("normal_law", At<Stepping, &SteppingOptions::normal_law>, {"impact", "gap", "strict", "feedback"},
             "bodies meet and rebound as told; the paper's one stage: max(0, gap) / dt; touching contacts; undoing overlap"),
      Real("feedback_beta", "-", At<Stepping, &SteppingOptions::feedback_beta>, Limits{0.0, 1.0},
           "part of the interpenetration that one step undoes, normal_law = feedback"),
      Real("feedback_slop", "m", At<Stepping, &SteppingOptions::feedback_slop>, kNotNegative,
           "interpenetration that is left alone, normal_law = feedback"),
      Real("feedback_cap", "m/s", At<Stepping, &SteppingOptions::feedback_cap>, kNotNegative,
           "largest recovery speed, normal_law = feedback"),
      Bool("warm_start", At<Stepping, &SteppingOptions::warm_start>, "start from the impulses of the previous step"),
  };
}

std::vector<Option> CommonOptions() {
  std::vector<Option> options = StoppingTable();
  for (Option& option : SteppingTable()) options.push_back(std::move(option));
  return options;
}

std::vector<Option> PartitionOptionTable() {
  return {
      Grid("subdomains", Partition, {1, 1e6}, "grid of subdomains over the mobile bodies, such as 4x2"),
      Integer("repartition_every", At<Partition, &PartitionOptions::repartition_every>, kPositiveCount,
              "steps between two placements of the grid"),
  };
}

std::vector<Option> AccelerationTable() {
  return {
      Choice("acceleration", At<Accelerated, &AccelerationOptions::method>, {"none", "anderson"},
             "of the iteration; none is that of the paper"),
      Integer("anderson_depth", At<Accelerated, &AccelerationOptions::depth>, Limits{1, 8},
              "earlier iterates that are combined with the last"),
      Integer("anderson_every", At<Accelerated, &AccelerationOptions::every>, kPositiveCount,
              "iterations between two extrapolations"),
  };
}

std::vector<Option> StageOptions() {
  return {
      Integer("sweeps_per_stage", SweepsPerStage, kPositiveCount, "sweeps of each subdomain between two interface updates")};
}

std::vector<Option> InterfaceOptions() {
  return {
      Real("lambda", "-", At<Interface, &AugmentedInterfaceOptions::lambda>, Limits{0.0, 1e8},
           "search direction over the reference mass; 0: the plain interface of nscdd; above 1e8 no digits are left"),
      Choice("compatibility", At<Interface, &AugmentedInterfaceOptions::compatibility>, {"normal", "full", "sticking"},
             "active contacts in the interface problem: normals; and tangents; and tangents of sticking ones"),
      Choice("status_compatibility", At<Interface, &AugmentedInterfaceOptions::status_compatibility>,
             {"same", "normal", "sticking"}, "contacts whose velocity enters the right-hand side, if other than in the matrix"),
      Choice("local_velocity", At<Interface, &AugmentedInterfaceOptions::local_velocity>, {"local", "current"},
             "velocity in the search direction: what each local solve left, or that of now"),
      Choice("lambda_scale", At<Interface, &AugmentedInterfaceOptions::lambda_scale>, {"mass", "contact"},
             "what lambda multiplies: the reference mass, or 1 / W_nn of each contact"),
      Real("reference_mass", "kg", At<Interface, &AugmentedInterfaceOptions::reference_mass>, kNotNegative,
           "0: mean mass of the free bodies"),
      Real("restoring", "-", At<Interface, &AugmentedInterfaceOptions::restoring>, Limits{0.0, 1.0},
           "part of the interpenetration that the interface problem alone undoes in a step"),
      Choice("interface", At<Interface, &AugmentedInterfaceOptions::solve>, {"direct", "cg"},
             "assembled and factorised, or by the conjugate gradient among neighbours"),
      Choice("linear_solver", At<Interface, &AugmentedInterfaceOptions::linear_solver>, {"auto", "eigen", "mumps"},
             "auto is eigen; mumps needs mpirun"),
      Choice("preconditioner", At<Interface, &AugmentedInterfaceOptions::preconditioner>,
             {"none", "diagonal", "lumped", "dirichlet"}, "of interface = cg"),
      Real("cg_tolerance", "-", At<Interface, &AugmentedInterfaceOptions::cg_tolerance>, Limits{0.0, 1.0, true},
           "fall of the jump in one update by interface = cg"),
      Integer("cg_max_iterations", At<Interface, &AugmentedInterfaceOptions::cg_max_iterations>, kPositiveCount,
              "of one update by interface = cg"),
  };
}

std::vector<Option> FeaOptionTable() {
  return {Bool("jump_guard", At<Only<FeaOptions>, &FeaOptions::jump_guard>,
               "plain updates for a while where the jump of the copies has more than doubled")};
}

std::vector<Option> NewtonOptionTable() {
  return {
      Choice("linear_solver", At<Only<NewtonOptions>, &NewtonOptions::linear_solver>, {"auto", "eigen", "mumps"},
             "auto is our block LU; mumps needs mpirun"),
  };
}

std::vector<Option> ReaOptionTable() {
  return {Integer("max_interface_updates", At<Only<ReaOptions>, &ReaOptions::max_interface_updates>, kPositiveCount,
                  "interface updates before the subdomains are solved by themselves")};
}

std::vector<Option> IeaOptionTable() {
  return {
      Integer("polish_sweeps", At<Only<IeaOptions>, &IeaOptions::polish_sweeps>, Limits{0, 2147483647},
              "closing sweeps of the contacts of interface bodies"),
      Integer("closing_updates", At<Only<IeaOptions>, &IeaOptions::closing_updates>, Limits{0, 2147483647},
              "closing iterations of nscdd (hybrid)"),
  };
}

/// Options of every solver, then the groups.
template <class... Groups>
std::vector<Option> Join(Groups... groups) {
  std::vector<Option> all = CommonOptions();
  (all.insert(all.end(), std::make_move_iterator(groups.begin()), std::make_move_iterator(groups.end())), ...);
  return all;
}

std::vector<SolverEntry> MakeTable() {
  return {
      {"nscd",
       "NonSmooth Contact Dynamics: nonlinear Gauss-Seidel sweeps over all contacts, one subdomain",
       {{}, NscdOptions{}},
       Join(AccelerationTable())},
      {"nscdd",
       "NSCD with domain decomposition: sweeps in each subdomain, then the mean velocity of each interface body",
       {{}, NscddOptions{}},
       Join(PartitionOptionTable(), StageOptions(), AccelerationTable())},
      {"fea",
       "fully enriched algorithm: nscdd with the augmented interface problem (lambda) after every sweep",
       {{}, FeaOptions{}},
       Join(PartitionOptionTable(), StageOptions(), InterfaceOptions(), AccelerationTable(), FeaOptionTable())},
      {"rea",
       "relaxed enriched algorithm: iterates until the interface agrees, then solves each subdomain by itself",
       {{}, ReaOptions{}},
       Join(PartitionOptionTable(), StageOptions(), InterfaceOptions(), ReaOptionTable())},
      {"iea",
       "incomplete enriched algorithm: one augmented interface problem a step, then each subdomain by itself",
       {{}, IeaOptions{}},
       Join(PartitionOptionTable(), InterfaceOptions(), IeaOptionTable())},
      {"newton",
       "high accuracy with friction: interior point iterations, one sparse factorisation each, and plain sweeps beside them; "
       "one subdomain",
       {{}, NewtonOptions{}},
       Join(NewtonOptionTable())},
  };
}

}  // namespace

const std::vector<SolverEntry>& SolverTable() {
  static const std::vector<SolverEntry> table = MakeTable();
  return table;
}

}  // namespace nscdd
