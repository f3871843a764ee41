// SPDX-License-Identifier: Apache-2.0
#include "nscdd/time_stepper.h"

#include <algorithm>
#include <utility>

#include "algorithms/algorithms.h"
#include "nscdd/agreement.h"
#include "nscdd/step_problem.h"
#include "problem/state.h"
#include "stepping/body_placement.h"
#include "stepping/contact_checks.h"
#include "stepping/meetings.h"
#include "stepping/midway.h"
#include "stepping/reconcile.h"
#include "stepping/saved_state.h"
#include "stepping/setup_checks.h"
#include "stepping/step_clock.h"
#include "stepping/step_outcome.h"
#include "stepping/step_problem.h"
#include "stepping/step_summary.h"
#include "stepping/step_tables.h"
#include "stepping/warm_start.h"

namespace nscdd {

namespace {

/// A step that is not settled by then says so (beyond_reach, unsettled): blows pass on in one or two, walls that turn take a
/// few.
constexpr int kMostRedetections = 6;

constexpr int kMostRefinements = 2;

}  // namespace

class TimeStepper::Impl {
 public:
  Impl(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter, Communicator* communicator)
      : stepping_(stepping),
        algorithm_(algorithm),
        partition_(PartitionOf(algorithm)),
        adapter_(adapter),
        communicator_(communicator),
        description_(Describe(stepping, algorithm, adapter, communicator)),
        placement_(stepping, partition_, adapter, description_, communicator) {}

  /// The scheme. Until Commit() nothing is told to the hosts but which bodies they hold, so a failed step may be tried again.
  const StepReport& Step(double dt) {
    StepClock clock(*communicator_);
    report_ = {};
    solves_ = 0;
    placement_.Begin(dt, &kept_, &cache_, &now_);
    PartitionedState state = SolveContacts(dt, &clock);
    if (has_two_stages()) {
      NextStage next = Refine(&state, dt);
      for (; next.detection && report_.redetections < kMostRedetections; next = Refine(&state, dt)) {
        ReturnToStart(dt);
        state = SolveContacts(dt, &clock);
      }
      report_.unsettled = next.detection;
      if (next.rebound) SolveVelocities(dt, &state);
      report_.seconds_solve += clock.Lap();
    }
    outcome_ = MoveBodies(population(), now_, kept_.grid, has_two_stages() ? dt : stepping_.theta * dt, communicator_->rank());
    Summarise(population(), now_, outcome_, stepping_, dt, communicator_, &report_);
    Commit();
    Conclude(dt, clock);
    return report_;
  }

  std::vector<std::byte> SaveState() const { return WriteState(kept_, cache_, partition_, *communicator_); }

  void LoadState(std::span<const std::span<const std::byte>> parts) {
    ImpulseCache cache;
    kept_ = ReadStates(parts, partition_, description_, communicator_, &cache);
    if (stepping_.alert_distance >= 0.0) kept_.alert = stepping_.alert_distance;
    placement_.Forget();
    cache_ = std::move(cache);
  }

  const StepOutcome& outcome() const { return outcome_; }

 private:
  const Population& population() const { return placement_.population(); }
  const BodyTable& bodies() const { return population().bodies; }
  double alert() const { return std::max(0.0, kept_.alert); }
  bool has_two_stages() const { return HasTwoStages(stepping_.normal_law); }
  static AdapterDescription Describe(const SteppingOptions& stepping, const AlgorithmOptions& algorithm,
                                     PlatformAdapter* adapter, Communicator* communicator) {
    AdapterDescription description;
    RunTogether(communicator, [&] { description = CheckSetup(stepping, algorithm, adapter, communicator->size()); });
    return description;
  }

  /// Once more from q_i, on the way that the bodies have taken and from the impulses that they got.
  void ReturnToStart(double dt) {
    ++report_.redetections;
    std::swap(cache_, next_cache_);
    kept_.cached_dt = dt;
    placement_.Return(dt, &kept_, &cache_, &now_);
  }

  PartitionedState SolveContacts(double dt, StepClock* clock) {
    DetectContacts(dt);
    report_.seconds_detect += clock->Lap();
    Assemble(dt);
    PartitionedState state = FirstIterate(dt);
    Solve(algorithm_, &state);
    Displace(state, dt);
    report_.seconds_solve += clock->Lap();
    return state;
  }

  void Solve(const AlgorithmOptions& algorithm, PartitionedState* state) {
    const SolveReport earlier = std::exchange(report_.solve, {});
    report_.solve = SolveAny(problem_, algorithm, communicator_, &workspace_, state);
    if (solves_++ > 0) AddSolve(earlier, &report_.solve);
  }

  /// V; in two stages W, and V as it is if nothing rebounds.
  void Displace(const PartitionedState& state, double dt) {
    Reconcile(problem_, state, population(), communicator_, &now_, &next_cache_);
    if (!has_two_stages()) return;
    now_.displacement = std::exchange(now_.velocity, {});
    now_.velocity = VelocitiesOf(bodies(), now_, dt);
    MoveMidway(population(), dt, communicator_->rank(), &now_);
  }

  /// Judges W; solves to a closer tolerance where bodies would stand deep in each other.
  NextStage Refine(PartitionedState* state, double dt) {
    AlgorithmOptions closer = algorithm_;
    for (int i = 0;; ++i) {
      const NextStage next = JudgeDisplacements(problem_, *state, population(), now_, kept_.grid, dt, communicator_);
      if (!next.precision || i == kMostRefinements) return next;
      std::visit([](auto& options) { options.stopping.tolerance *= 1e-2; }, closer);
      Solve(closer, state);
      Displace(*state, dt);
    }
  }

  /// From the impulses of the displacements; these, not its own, are what the next step starts from.
  void SolveVelocities(double dt, PartitionedState* state) {
    ++report_.second_solves;
    AskForRebounds(bodies(), dt, &now_, &problem_, state);
    Solve(algorithm_, state);
    ImpulseCache unused;
    Reconcile(problem_, *state, population(), communicator_, &now_, &unused);
  }

  /// Contacts there, or at the moments of the sweep, each to the subdomain of its site; which bodies several subdomains share.
  void DetectContacts(double dt) {
    SubdomainPairs touched;
    RunTogether(communicator_, [&] {
      now_.contacts.Clear();
      if (has_two_stages()) {
        CheckMotion(bodies(), now_.motion);
        adapter_->SweepContacts({bodies().id, now_.detection, now_.motion, now_.reach, dt}, &now_.contacts);
      } else {
        adapter_->DetectContacts({bodies().id, now_.detection}, alert(), &now_.contacts);
      }
      CheckContacts(now_.contacts, bodies(), now_.reach, has_two_stages() ? "SweepContacts" : "DetectContacts", description_);
      const int rank = communicator_->rank();
      const Blocks& blocks = placement_.blocks();
      now_.chosen = ChooseContacts(now_.contacts, stepping_.normal_law, kept_.grid, blocks.First(rank), blocks.Count(rank));
      touched = TouchedBodies(now_.contacts, now_.chosen, bodies().size(),
                              [&](std::int32_t row) { return bodies().kind[row] == BodyKind::kFree; });
    });
    now_.is_hindered = has_two_stages() ? HinderedBodies(now_, dt) : std::vector<std::uint8_t>(bodies().size(), 0);
    now_.sharing = CompleteSharing(population(), std::move(touched), &now_.is_hindered, communicator_);
  }

  /// The step's problem: V_f, b_n, what all ranks must know, then H and W of every subdomain and the interface.
  void Assemble(double dt) {
    now_.columns = MakeColumns(bodies(), now_.motion, now_.contacts, now_.chosen, stepping_, dt);
    if (has_two_stages()) FreeDisplacements(bodies(), now_.is_hindered, dt, &now_.columns);
    const ProblemTables tables = TablesOf(now_.columns, now_.contacts, now_.sharing);
    std::vector<ProblemPart> parts = PartsOfBodies(population(), now_.home, now_.chosen, dt, communicator_->rank());
    AddContacts(now_.chosen, now_.contacts, now_.columns, &parts);
    const ProblemTotals totals = ReduceTotals(std::move(parts), RequiredModel(tables), communicator_);
    problem_ = AssembleProblem(tables, bodies().id, now_.chosen, totals, placement_.blocks(), communicator_->rank());
    problem_.dt = dt;
    report_.bodies = totals.bodies;
    report_.mean_radius = totals.mean_radius;
    report_.alert_distance = alert();
  }

  /// From the impulses of the step before, or zero.
  PartitionedState FirstIterate(double dt) {
    if (!stepping_.warm_start || kept_.cached_dt == 0.0) return InitialState(problem_, {});
    return WarmState(problem_, cache_, now_.sharing, dt / kept_.cached_dt, communicator_);
  }

  /// Poses, velocities and impulses, core -> host.
  void Commit() {
    const BodyResults& b = outcome_.bodies;
    const ContactResults& c = outcome_.contacts;
    RunTogether(communicator_, [&] { adapter_->Commit({b.id, b.pose, b.velocity, c.key, c.impulse}); });
  }

  void Conclude(double dt, const StepClock& clock) {
    std::swap(cache_, next_cache_);
    kept_.cached_dt = dt;
    report_.step = ++kept_.step;
    report_.time = kept_.time += dt;
    SummariseCommunication(clock.Communication(), placement_.migrated(), communicator_, &report_);
    report_.seconds_communicate = clock.Communication().seconds;
    report_.seconds_total = clock.Total();
  }

  // Constant.
  SteppingOptions stepping_;
  AlgorithmOptions algorithm_;
  PartitionOptions partition_;
  PlatformAdapter* adapter_;
  Communicator* communicator_;
  AdapterDescription description_;

  // Kept between steps.
  StepperState kept_;
  BodyPlacement placement_;
  ImpulseCache cache_, next_cache_;  // the next one takes its place once the step has succeeded
  InterfaceWorkspace workspace_;

  // Of the present step.
  int solves_ = 0;
  StepTables now_;
  PartitionedProblem problem_;
  StepOutcome outcome_;
  StepReport report_;
};

TimeStepper::TimeStepper(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter,
                         Communicator* communicator)
    : impl_(std::make_unique<Impl>(stepping, algorithm, adapter, communicator)) {}
TimeStepper::~TimeStepper() = default;
TimeStepper::TimeStepper(TimeStepper&&) noexcept = default;

const StepReport& TimeStepper::Step(double dt) { return impl_->Step(dt); }
std::vector<std::byte> TimeStepper::SaveState() const { return impl_->SaveState(); }
void TimeStepper::LoadState(std::span<const std::byte> bytes) { impl_->LoadState({&bytes, 1}); }
void TimeStepper::LoadState(std::span<const std::span<const std::byte>> parts) { impl_->LoadState(parts); }
const BodyResults& TimeStepper::bodies() const { return impl_->outcome().bodies; }
const ContactResults& TimeStepper::contacts() const { return impl_->outcome().contacts; }

}  // namespace nscdd
