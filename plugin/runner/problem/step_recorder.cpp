// SPDX-License-Identifier: Apache-2.0
#include "problem/step_recorder.h"

#include <algorithm>
#include <numeric>

#include "nscdd/error.h"
#include "problem/step_assembly.h"

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

void StepRecorder::Commit(const StepResult& result) {
  adapter_->Commit(result);
  velocity_.assign(result.velocity.begin(), result.velocity.end());
  key_.assign(result.key.begin(), result.key.end());
  impulse_.assign(result.impulse.begin(), result.impulse.end());
  committed_ = true;
}

RecordedStep StepRecorder::Problem(const SteppingOptions& stepping, double dt) const {
  if (!committed_) throw Error("no step was solved yet, so there is no contact problem to show; solve one step at least");
  RecordedStep step{bodies_, AssembleStep(bodies_, contacts_, stepping, dt), velocity_, {}};
  if (key_.size() < step.problem.contacts.size()) {
    throw Error("the solver committed fewer impulses than it was given contacts; export needs all of them");
  }
  std::vector<std::size_t> order(
      key_.size());  // a step of several subdomains commits one subdomain's contacts behind the other's
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key_[a] < key_[b]; });
  for (std::size_t c = 0; c < step.problem.contacts.size(); ++c) step.impulse.push_back(impulse_[order[c]]);
  return step;
}

}  // namespace nscdd
