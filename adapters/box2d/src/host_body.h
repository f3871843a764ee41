// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include <cstdint>

#include "nscdd/body_table.h"

namespace nscdd::box2d {

/// The floats of a b2Body that have a double-precision master here; what differs from last time was edited by the user.
struct HostMirror {
  b2Vec2 position{0.0f, 0.0f};      // of the body's origin
  b2Vec2 local_centre{0.0f, 0.0f};  // centre of mass in the body's own frame
  b2Vec2 velocity{0.0f, 0.0f};
  float angle = 0.0f;
  float spin = 0.0f;
  float mass = 0.0f;
  float inertia = 0.0f;  // about the centre of mass
};

/// `scale` is metres per Box2D unit throughout.
HostMirror ReadMirror(const b2Body& body);
/// Of the centre of mass, the offset from the origin turned in double precision.
Pose PoseOf(const HostMirror& mirror, double scale);
Twist TwistOf(const HostMirror& mirror, double scale);
/// What ApplyForce, ApplyForceToCenter and ApplyTorque have gathered [N, N m]; Box2D has no accessor for it.
Wrench NativeLoad(const b2Body& body, double scale);

inline BodyKind KindOf(const b2Body& body) {
  return body.GetType() == b2_dynamicBody ? BodyKind::kFree : BodyKind::kPrescribed;
}

/// Changes whenever anything that shapes, filters and materials come from has changed.
std::uint64_t FingerprintOf(const b2Body& body);

/// Throw Error that names the body if it is dynamic, enabled and something of it is not modelled.
void CheckFixtures(const b2Body& body, std::int64_t id);
void CheckMotion(const b2Body& body, std::int64_t id);

/// Leave the body alone where its floats are right already.
void WritePose(const Pose& pose, double scale, b2Body* body);
void WriteVelocity(const Twist& velocity, double scale, b2Body* body);
void WriteMass(double mass, double inertia, double scale, b2Body* body);

}  // namespace nscdd::box2d
