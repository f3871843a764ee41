// SPDX-License-Identifier: Apache-2.0
#include "host_world.h"

#include <utility>

#include "nscdd/error.h"

namespace nscdd::box2d {
namespace {

class NothingCollides final : public b2ContactFilter {
 public:
  bool ShouldCollide(b2Fixture*, b2Fixture*) override { return false; }
};

}  // namespace

void HostWorld::CheckUnlocked() const {
  if (!world_->IsLocked()) return;
  throw Error("The b2World is locked: it is inside b2World::Step or one of its callbacks; call the solver outside of them.");
}

Vec2 HostWorld::ReadGravity() {
  const b2Vec2 now = world_->GetGravity();
  if (!(now == gravity_seen_)) {
    gravity_seen_ = now;
    gravity_ = {scale_ * now.x, scale_ * now.y};
  }
  return gravity_;
}

void HostWorld::SetGravity(Vec2 gravity) {
  gravity_ = gravity;
  gravity_seen_.Set(static_cast<float>(gravity.x / scale_), static_cast<float>(gravity.y / scale_));
  world_->SetGravity(gravity_seen_);
}

void HostWorld::AddPath(double length, int fixtures) {
  moves_ += fixtures * length / b2_aabbExtension;  // a box is left after b2_aabbExtension at the earliest
}

void HostWorld::ForgetMovesIfMany() {
  if (moves_ < 16.0 * world_->GetProxyCount() + 4096.0) return;
  NothingCollides filter;
  const b2ContactManager& manager = world_->GetContactManager();
  b2ContactFilter* const users_filter = manager.m_contactFilter;
  b2ContactListener* const users_listener = manager.m_contactListener;
  const bool clears_forces = world_->GetAutoClearForces();
  world_->SetContactFilter(&filter);
  world_->SetContactListener(nullptr);
  world_->SetAutoClearForces(false);
  world_->Step(0.0f, 0, 0);
  world_->SetAutoClearForces(clears_forces);
  world_->SetContactListener(users_listener);
  world_->SetContactFilter(users_filter);
  moves_ = 0.0;
}

void HostWorld::RefreshContacts() {
  // Setting a transform, even the same, is what makes the next step look for pairs before it solves.
  if (b2Body* any = world_->GetBodyList()) any->SetTransform(any->GetPosition(), any->GetAngle());
  for (b2Body* body = world_->GetBodyList(); body != nullptr; body = body->GetNext()) {
    for (b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr; fixture = fixture->GetNext()) fixture->Refilter();
  }
}

}  // namespace nscdd::box2d
