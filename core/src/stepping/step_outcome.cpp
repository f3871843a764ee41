// SPDX-License-Identifier: Apache-2.0
#include "stepping/step_outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nscdd/error.h"

namespace nscdd {
namespace {

bool HasNumbers(const BodyRecord& b) {
  return std::isfinite(b.pose.x + b.pose.y + b.pose.angle) && std::isfinite(b.velocity.vx + b.velocity.vy + b.velocity.spin);
}

}  // namespace

bool StepOutcome::IsFinite() const { return std::all_of(bodies.begin(), bodies.end(), HasNumbers); }

void StepOutcome::RequireFinite() const {
  const auto bad = std::find_if_not(bodies.begin(), bodies.end(), HasNumbers);
  if (bad == bodies.end()) return;
  throw Error(
      fmt::format("the solver made a position or velocity of body {} that is not finite; nothing was written back", bad->id));
}

void StepOutcome::Commit(PlatformAdapter* adapter) const {
  std::vector<std::int64_t> id;
  std::vector<Pose> pose;
  std::vector<Twist> velocity;
  id.reserve(bodies.size());
  pose.reserve(bodies.size());
  velocity.reserve(bodies.size());
  for (const BodyRecord& body : bodies) {
    id.push_back(body.id);
    pose.push_back(body.pose);
    velocity.push_back(body.velocity);
  }
  std::vector<ContactKey> key;
  std::vector<Vec2> impulse;
  key.reserve(contacts.size());
  impulse.reserve(contacts.size());
  for (const ContactRecord& contact : contacts) {
    key.push_back(contact.key);
    impulse.push_back(contact.impulse);
  }
  adapter->Commit({id, pose, velocity, key, impulse});
}

}  // namespace nscdd
