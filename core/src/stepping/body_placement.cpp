// SPDX-License-Identifier: Apache-2.0
#include "stepping/body_placement.h"

#include <algorithm>
#include <utility>

#include "nscdd/agreement.h"
#include "nscdd/normal_law.h"
#include "nscdd/step_problem.h"
#include "partition/domain_extent.h"
#include "partition/impulse_directory.h"
#include "partition/unique_ids.h"
#include "stepping/contact_checks.h"
#include "stepping/meetings.h"
#include "stepping/setup_checks.h"

namespace nscdd {

BodyPlacement::BodyPlacement(const SteppingOptions& stepping, const PartitionOptions& partition, PlatformAdapter* adapter,
                             const AdapterDescription& description, Communicator* communicator)
    : stepping_(stepping),
      partition_(partition),
      adapter_(adapter),
      description_(description),
      communicator_(communicator),
      blocks_(partition.nx * partition.ny, communicator->size()),
      migration_(adapter, communicator) {}

void BodyPlacement::Begin(double dt, StepperState* kept, ImpulseCache* cache, StepTables* now) {
  known_ = {};
  migrated_ = 0;
  Read(dt, kept, cache);
  Settle(dt, true, kept, cache, now);
}

void BodyPlacement::Return(double dt, StepperState* kept, ImpulseCache* cache, StepTables* now) {
  known_ = NextMotion(population(), *now, dt, communicator_);
  if (communicator_->size() == 1) return Locate(dt, *kept, now);
  RunTogether(communicator_, [&] { migration_.TakeOver(BodyTable(population().bodies)); });  // the hosts' have not changed
  Settle(dt, false, kept, cache, now);
  std::vector<Twist> displacement = MotionOf(population().bodies, known_, known_.displacement, dt);
  ShareMotion(population(), communicator_, &now->motion);
  ShareMotion(population(), communicator_, &displacement);
  now->reach = ReachesOf(population().bodies, displacement, std::max(0.0, kept->alert), description_.period, dt);
}

void BodyPlacement::Forget() {
  migration_.Forget();
  is_cache_scattered_ = true;
}

/// Time from the beginning of the step to the detection [s].
double BodyPlacement::Before(double dt) const {
  return HasTwoStages(stepping_.normal_law) ? 0.0 : (1.0 - stepping_.theta) * dt;
}

void BodyPlacement::Read(double dt, StepperState* kept, ImpulseCache* cache) {
  RunTogether(communicator_, [&] {
    CheckTimeStep(dt);
    BodyTable read;
    adapter_->ReadBodies(&read);
    CheckBodies(read, description_);
    CheckDrift(read, HasTwoStages(stepping_.normal_law) ? dt : Before(dt), description_);
    migration_.TakeOver(std::move(read));
  });
  const BodyTable& bodies = population().bodies;
  if (is_cache_scattered_) DeliverToOwners(bodies.id, communicator_, cache);
  if (kept->alert < 0.0) kept->alert = stepping_.alert_distance;
  if (kept->alert < 0.0) kept->alert = DefaultAlertDistance(bodies, communicator_);
}

void BodyPlacement::Settle(double dt, bool is_first, StepperState* kept, ImpulseCache* cache, StepTables* now) {
  Grid& grid = kept->grid;
  if (kept->step == 0 && is_first) grid = GridOver({}, partition_, description_);  // its period
  Locate(dt, *kept, now);
  const DomainExtent extent =
      ReduceExtent(population().bodies, now->detection, now->reach, migration_.newcomers(), dt, communicator_);
  const bool is_of_others = grid.nx() != partition_.nx || grid.ny() != partition_.ny;  // of a state that was loaded
  if (is_first && (is_of_others || kept->step % partition_.repartition_every == 0)) {
    grid = GridOver(extent, partition_, description_);
  }
  if (extent.newcomers) CheckIdsAreUnique(population().bodies.id, communicator_);
  migration_.Move(now->detection, grid, blocks_, {extent.largest_radius, extent.largest_reach, now->reach}, cache);
  migrated_ += migration_.migrated();
  is_cache_scattered_ = false;
  if (communicator_->size() > 1) Locate(dt, *kept, now);  // rows have come and gone
  now->home = CellsOf(now->detection, grid);
}

/// Where contacts are looked for, and how far.
void BodyPlacement::Locate(double dt, const StepperState& kept, StepTables* now) const {
  const BodyTable& bodies = population().bodies;
  const double alert = std::max(0.0, kept.alert);
  now->detection = Drifted(bodies, kept.grid, Before(dt));
  if (!HasTwoStages(stepping_.normal_law)) {
    now->reach.assign(bodies.size(), 0.5 * alert);
    return;
  }
  now->motion = MotionOf(bodies, known_, known_.way, dt);
  now->reach = ReachesOf(bodies, MotionOf(bodies, known_, known_.displacement, dt), alert, description_.period, dt);
}

}  // namespace nscdd
