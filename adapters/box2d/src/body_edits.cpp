// SPDX-License-Identifier: Apache-2.0
// The part of BodyStore that keeps master and mirror together.
#include <fmt/format.h>

#include <cmath>

#include "body_store.h"
#include "nscdd/error.h"

namespace nscdd::box2d {

void BodyStore::Refresh(Vec2 gravity) {
  has_native_load_ = false;
  for (const Walked& walked : order_) RefreshBody(walked.slot, gravity);
}

void BodyStore::RefreshBody(std::int32_t slot, Vec2 gravity) {
  BodyRecord& r = record(slot);
  const bool is_new = r.fingerprint == 0;
  CheckMotion(*r.body, r.id);
  if (FingerprintOf(*r.body) != r.fingerprint) {
    CheckFixtures(*r.body, r.id);
    AdoptEdits(&r, is_new);
    StoreShapes(slot, DraftShapes(*r.body, scale_));
  } else {
    AdoptEdits(&r, false);
    if (r.body->IsEnabled() != r.is_enabled || KindOf(*r.body) != r.kind) {
      CheckFixtures(*r.body, r.id);
      std::vector<ShapeDraft> drafts = DraftShapes(*r.body, scale_);
      ApplyExact(ExactOf(slot).shapes, r.id, &drafts);
      StoreShapes(slot, std::move(drafts));
    }
  }
  CheckFinite(r);
  if (r.kind == BodyKind::kPrescribed) return;
  const Wrench native = NativeLoad(*r.body, scale_);
  has_native_load_ = has_native_load_ || native.fx != 0.0 || native.fy != 0.0 || native.torque != 0.0;
  const double weight = r.body->GetGravityScale() * r.mass;
  r.force = {weight * gravity.x + native.fx + r.added_load.fx, weight * gravity.y + native.fy + r.added_load.fy,
             native.torque + r.added_load.torque};
}

/// What differs from the floats last seen was edited; the rest keeps its double precision.
void BodyStore::AdoptEdits(BodyRecord* r, bool all) const {
  const HostMirror now = ReadMirror(*r->body), &seen = r->seen;
  const auto edited = [all](float value, float before) { return all || value != before; };
  const bool x_edited = edited(now.position.x, seen.position.x), y_edited = edited(now.position.y, seen.position.y);
  const bool turned = edited(now.angle, seen.angle), recentred = !(now.local_centre == seen.local_centre);
  if (x_edited || y_edited || turned || recentred) {
    // The centre of mass of a cluster depends on all of them, that of a disk on its own coordinate.
    const bool all_count = recentred || now.local_centre.x != 0.0f || now.local_centre.y != 0.0f;
    const Pose pose = PoseOf(now, scale_);
    if (x_edited || all_count) r->pose.x = pose.x;
    if (y_edited || all_count) r->pose.y = pose.y;
    if (turned) r->pose.angle = pose.angle;
  }
  const Twist velocity = TwistOf(now, scale_);
  if (edited(now.velocity.x, seen.velocity.x)) r->velocity.vx = velocity.vx;
  if (edited(now.velocity.y, seen.velocity.y)) r->velocity.vy = velocity.vy;
  if (edited(now.spin, seen.spin)) r->velocity.spin = velocity.spin;
  if (edited(now.mass, seen.mass)) r->mass = now.mass;
  if (edited(now.inertia, seen.inertia)) r->inertia = scale_ * scale_ * now.inertia;
  r->seen = now;
}

void BodyStore::CheckFinite(const BodyRecord& r) const {
  const Pose& q = r.pose;
  const Twist& v = r.velocity;
  if (std::isfinite(q.x + q.y + q.angle) && std::isfinite(v.vx + v.vy + v.spin) && std::isfinite(r.mass + r.inertia)) return;
  throw Error(fmt::format(
      "Box2D body {} is at ({}, {}, {}) with velocity ({}, {}, {}), mass {} and inertia {}: give it finite numbers.", r.id, q.x,
      q.y, q.angle, v.vx, v.vy, v.spin, r.mass, r.inertia));
}

void BodyStore::SetPose(std::int32_t slot, const Pose& pose) {
  BodyRecord& r = record(slot);
  r.pose = pose;
  WritePose(pose, scale_, r.body);
  r.seen.position = r.body->GetPosition();
  r.seen.angle = r.body->GetAngle();
}

void BodyStore::SetVelocity(std::int32_t slot, const Twist& velocity) {
  BodyRecord& r = record(slot);
  if (r.body->GetType() == b2_staticBody) return;
  r.velocity = velocity;
  WriteVelocity(velocity, scale_, r.body);
  r.seen.velocity = r.body->GetLinearVelocity();
  r.seen.spin = r.body->GetAngularVelocity();
}

}  // namespace nscdd::box2d
