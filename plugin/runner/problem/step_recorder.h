// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nscdd/contact_problem.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"

namespace nscdd {

/// The contact problem of one time step, and what a solver answered.
struct RecordedStep {
  BodyTable bodies;             ///< at the beginning of the step, ascending ids; rows of the problem
  ContactProblem problem;       ///< contacts by key, without those that the normal law does not see
  std::vector<Twist> velocity;  ///< V by row of bodies
  std::vector<Vec2> impulse;    ///< (r_n, r_t) by contact [N s]
};

/// Stands between a solver and an adapter, on one rank, and keeps what the last step read, found and committed: so the problem
/// that is looked at is the one that was solved.
class StepRecorder final : public PlatformAdapter {
 public:
  /// Keeps the pointer.
  explicit StepRecorder(PlatformAdapter* adapter) : adapter_(adapter) {}

  AdapterDescription Describe() const override;
  void ReadBodies(BodyTable* bodies) override;
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  void Commit(const StepResult& result) override;
  BodyTransport* transport() override { return nullptr; }

  /// Of the last committed step, of length dt [s]. `stepping`: its normal law, which makes b_n. Throws Error when there was no
  /// step.
  RecordedStep Problem(const SteppingOptions& stepping, double dt) const;

 private:
  PlatformAdapter* adapter_;
  BodyTable bodies_;  // in ascending order of id
  ContactTable contacts_;
  std::vector<Twist> velocity_;
  std::vector<ContactKey> key_;
  std::vector<Vec2> impulse_;
  bool committed_ = false;
};

}  // namespace nscdd
