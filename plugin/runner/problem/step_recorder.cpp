// SPDX-License-Identifier: Apache-2.0
#include "problem/problem_file.h"

#include "nscdd/error.h"
#include "nscdd/step_problem.h"
#include "results/result_tables.h"

namespace nscdd {

AdapterDescription StepRecorder::Describe() const {
  AdapterDescription description = adapter_->Describe();
  description.distributed_bodies = false;
  return description;
}

void StepRecorder::ReadBodies(BodyTable* bodies) {
  adapter_->ReadBodies(bodies);
  bodies_ = SortedById(*bodies);
}

void StepRecorder::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  adapter_->DetectContacts(poses, alert, contacts);
  contacts_ = *contacts;
}

void StepRecorder::SweepContacts(const MotionView& motion, ContactTable* contacts) {
  adapter_->SweepContacts(motion, contacts);
  contacts_ = *contacts;
  motion_.assign(motion.velocity.begin(), motion.velocity.end());
}

void StepRecorder::Commit(const StepResult& result) {
  adapter_->Commit(result);
  velocity_.assign(result.velocity.begin(), result.velocity.end());
  key_.assign(result.key.begin(), result.key.end());
  impulse_.assign(result.impulse.begin(), result.impulse.end());
  committed_ = true;
}

RecordedStep StepRecorder::Problem(const SteppingOptions& stepping, double dt) const {
  if (!committed_) throw Error("no step was solved yet, so there is no contact problem to show; solve one step at least");
  RecordedStep step{bodies_, PoseStep(bodies_, motion_, contacts_, stepping, dt), velocity_, {}};
  if (key_.size() < step.problem.contacts.size()) {
    throw Error("the solver committed fewer impulses than it was given contacts; export needs all of them");
  }
  // A step of several subdomains commits one subdomain's contacts behind the other's.
  const std::vector<std::size_t> order = AscendingOrder(key_);
  for (std::size_t c = 0; c < step.problem.contacts.size(); ++c) step.impulse.push_back(impulse_[order[c]]);
  return step;
}

}  // namespace nscdd
