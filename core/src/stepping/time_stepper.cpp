// SPDX-License-Identifier: Apache-2.0
#include "nscdd/time_stepper.h"

#include <algorithm>
#include <utility>

#include "algorithms/algorithms.h"
#include "nscdd/agreement.h"
#include "nscdd/step_problem.h"
#include "partition/body_migration.h"
#include "partition/domain_extent.h"
#include "partition/impulse_directory.h"
#include "partition/unique_ids.h"
#include "problem/state.h"
#include "stepping/contact_checks.h"
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

class TimeStepper::Impl {
 public:
  Impl(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter, Communicator* communicator)
      : stepping_(stepping),
        algorithm_(algorithm),
        partition_(PartitionOf(algorithm)),
        adapter_(adapter),
        communicator_(communicator),
        migration_(adapter, communicator) {
    RunTogether(communicator, [&] { description_ = CheckSetup(stepping, algorithm, adapter, communicator->size()); });
    blocks_ = Blocks(partition_.nx * partition_.ny, communicator->size());
  }

  /// The scheme. Until Commit() nothing is told to the hosts but which bodies they hold, so a failed step may be tried again.
  const StepReport& Step(double dt) {
    StepClock clock(*communicator_);
    report_ = {};
    ReadBodies(dt);
    Migrate(dt);
    DetectContacts();
    report_.seconds_detect = clock.Lap();
    Assemble(dt);
    PartitionedState state = FirstIterate(dt);
    report_.solve = SolveAny(problem_, algorithm_, communicator_, &workspace_, &state);
    Reconcile(problem_, state, population(), communicator_, &now_, &next_cache_);
    report_.seconds_solve = clock.Lap();
    outcome_ = MoveBodies(population(), now_, kept_.grid, stepping_.theta * dt, communicator_->rank());
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
    migration_.Forget();
    cache_ = std::move(cache);
    is_cache_scattered_ = true;
  }

  const StepOutcome& outcome() const { return outcome_; }

 private:
  const Population& population() const { return migration_.population(); }
  const BodyTable& bodies() const { return population().bodies; }
  double alert() const { return std::max(0.0, kept_.alert); }

  /// Masses, poses, velocities and loads, host -> core.
  void ReadBodies(double dt) {
    RunTogether(communicator_, [&] {
      CheckTimeStep(dt);
      BodyTable read;
      adapter_->ReadBodies(&read);
      CheckBodies(read, description_);
      CheckDrift(read, (1.0 - stepping_.theta) * dt, description_);
      migration_.TakeOver(std::move(read));
    });
    if (is_cache_scattered_) DeliverToOwners(bodies().id, communicator_, &cache_);
    if (kept_.alert < 0.0) kept_.alert = stepping_.alert_distance;
    if (kept_.alert < 0.0) kept_.alert = DefaultAlertDistance(bodies(), communicator_);
  }

  /// q_m = q_i + (1 - theta) dt V_i; the cuts, over the free bodies at q_m; each body to the rank of its home cell, and ghosts
  /// to where contacts may need them.
  void Migrate(double dt) {
    const double half = (1.0 - stepping_.theta) * dt;
    Grid& grid = kept_.grid;
    if (kept_.step == 0) grid = GridOver({}, partition_, description_);  // its period
    now_.detection = Drifted(bodies(), grid, half);
    const DomainExtent extent = ReduceExtent(bodies(), now_.detection, migration_.newcomers(), dt, communicator_);
    const bool is_of_others = grid.nx() != partition_.nx || grid.ny() != partition_.ny;  // of a state that was loaded
    if (is_of_others || kept_.step % partition_.repartition_every == 0) grid = GridOver(extent, partition_, description_);
    if (extent.newcomers) CheckIdsAreUnique(bodies().id, communicator_);
    migration_.Move(now_.detection, grid, blocks_, {extent.largest_radius, alert()}, &cache_);
    is_cache_scattered_ = false;
    if (communicator_->size() > 1) now_.detection = Drifted(bodies(), grid, half);  // rows have come and gone
    now_.home = CellsOf(now_.detection, grid);
  }

  /// Contacts at q_m, each to the subdomain of its site; which bodies several subdomains share.
  void DetectContacts() {
    SubdomainPairs touched;
    RunTogether(communicator_, [&] {
      now_.contacts.Clear();
      adapter_->DetectContacts({bodies().id, now_.detection}, alert(), &now_.contacts);
      CheckContacts(now_.contacts, bodies(), alert(), description_);
      const int rank = communicator_->rank();
      now_.chosen = ChooseContacts(now_.contacts, stepping_.normal_law, kept_.grid, blocks_.First(rank), blocks_.Count(rank));
      touched = TouchedBodies(now_.contacts, now_.chosen, bodies().size(),
                              [&](std::int32_t row) { return bodies().kind[row] == BodyKind::kFree; });
    });
    now_.sharing = CompleteSharing(population(), std::move(touched), communicator_);
  }

  /// The step's problem: V_f, b_n, what all ranks must know, then H and W of every subdomain and the interface.
  void Assemble(double dt) {
    now_.columns = MakeColumns(bodies(), now_.contacts, now_.chosen, stepping_, dt);
    const ProblemTables tables = TablesOf(now_.columns, now_.contacts, now_.sharing);
    std::vector<ProblemPart> parts = PartsOfBodies(population(), now_.home, now_.chosen, dt, communicator_->rank());
    AddContacts(now_.chosen, now_.contacts, now_.columns, &parts);
    const ProblemTotals totals = ReduceTotals(std::move(parts), RequiredModel(tables), communicator_);
    problem_ = AssembleProblem(tables, bodies().id, now_.chosen, totals, blocks_, communicator_->rank());
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
    SummariseCommunication(clock.Communication(), migration_.migrated(), communicator_, &report_);
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
  Blocks blocks_;

  // Kept between steps.
  StepperState kept_;
  BodyMigration migration_;
  ImpulseCache cache_, next_cache_;  // the next one takes its place once the step has succeeded
  bool is_cache_scattered_ = false;  // loaded: its entries may be on other ranks than their bodies
  InterfaceWorkspace workspace_;

  // Of the present step.
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
