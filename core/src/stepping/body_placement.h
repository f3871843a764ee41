// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nscdd/communicator.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"
#include "partition/body_migration.h"
#include "partition/grid.h"
#include "partition/impulse_cache.h"
#include "partition/population.h"
#include "stepping/motion.h"
#include "stepping/saved_state.h"
#include "stepping/step_tables.h"

namespace nscdd {

/// Brings the bodies to where a step's detection needs them: out of the hosts, to the ranks of their home cells, with ghosts as
/// far as contacts may reach. All functions are collective.
class BodyPlacement {
 public:
  BodyPlacement(const SteppingOptions& stepping, const PartitionOptions& partition, PlatformAdapter* adapter,
                const AdapterDescription& description, Communicator* communicator);

  /// At the beginning of a step of `dt`: masses, poses, velocities and loads, host -> core; the cuts, over the free bodies
  /// where contacts are looked for (q_i, or q_m = q_i + (1 - theta) dt V_i); each body to its rank. Fills now->detection,
  /// reach, motion and home.
  void Begin(double dt, StepperState* kept, ImpulseCache* cache, StepTables* now);

  /// Once more from the beginning of the step, with what its first stage has shown and within the same cuts.
  void Return(double dt, StepperState* kept, ImpulseCache* cache, StepTables* now);

  /// A state was loaded: every body is in one host, entries of the cache on any rank.
  void Forget();

  const Population& population() const { return migration_.population(); }
  std::int64_t migrated() const { return migrated_; }  ///< bodies that left this rank in the step
  const Blocks& blocks() const { return blocks_; }

 private:
  void Read(double dt, StepperState* kept, ImpulseCache* cache);
  void Settle(double dt, bool is_first, StepperState* kept, ImpulseCache* cache, StepTables* now);
  void Locate(double dt, const StepperState& kept, StepTables* now) const;
  double Before(double dt) const;

  SteppingOptions stepping_;
  PartitionOptions partition_;
  PlatformAdapter* adapter_;
  AdapterDescription description_;
  Communicator* communicator_;
  Blocks blocks_;
  BodyMigration migration_;
  KnownMotion known_;                // of the step, after its first detection
  bool is_cache_scattered_ = false;  // loaded: its entries may be on other ranks than their bodies
  std::int64_t migrated_ = 0;
};

}  // namespace nscdd
