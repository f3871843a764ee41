// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "nscdd/box2d/exact_body.h"
#include "nscdd/platform_adapter.h"

class b2Body;
class b2Fixture;
class b2World;

namespace nscdd::box2d {

/// What a contact did in the step that is being committed; the counterpart of b2ContactListener::PostSolve.
struct ContactImpulse {
  ContactKey key;
  b2Fixture* fixture_a = nullptr;
  b2Fixture* fixture_b = nullptr;
  Vec2 impulse;  ///< (r_n, r_t) [N s], conventions of ContactTable
};

/// How a b2World is read: its unit, its period, its joints.
struct Box2dOptions {
  /// Length of one Box2D unit [m]. Box2D's own lengths (b2_linearSlop 0.005, b2_aabbExtension 0.1, b2_polygonRadius 0.01) are
  /// in units, so choose about the mean grain radius. Masses are in kg on both sides: a density is in kg per square unit.
  double metres_per_unit = 1.0;
  double period = 0.0;         ///< [m] of the periodic direction x; 0: not periodic
  double period_origin = 0.0;  ///< [m] centres of free bodies are kept in [period_origin, period_origin + period)
  /// Joints are not solved, so a joint on a dynamic body is refused. True: accept them as mere filters (collideConnected).
  bool joints_only_filter = false;
  /// Called by Commit for every contact with r_n > 0, in the order of StepResult. Must not change the world.
  std::function<void(const ContactImpulse&)> impulse_listener;
};

/// Binds the solver to a b2World that the user owns and that must outlive the adapter.
///
/// The adapter keeps pose and velocity of every body in double precision; the world is their float mirror. A value that the
/// user changes in the world (SetTransform, SetLinearVelocity, ApplyLinearImpulse, fixtures, mass, gravity ...) is adopted by
/// the next ReadBodies; a value that nobody changed keeps its double precision.
///
/// Bodies: dynamic -> kFree (circle fixtures only, several make a cluster); static and kinematic -> kPrescribed (circles,
/// edges, chains, polygons). Ids: the one given to Assign, else the next free number in order of creation. Disabled bodies are
/// left out. Shape number (ContactKey): fixtures in order of creation, every child of a chain counting as one.
/// b2World::Step is never called with a time step, so contact listeners are silent; see Box2dOptions::impulse_listener.
///
/// Refused with an Error that names the body: dynamic bodies with another fixture than circles (sensors excepted), without
/// mass or inertia, with fixed rotation or damping; joints on dynamic bodies; a locked world.
class Box2dAdapter final : public PlatformAdapter {
 public:
  /// Throws Error on options without meaning.
  explicit Box2dAdapter(b2World* world, Box2dOptions options = {});
  ~Box2dAdapter() override;
  Box2dAdapter(const Box2dAdapter&) = delete;
  Box2dAdapter& operator=(const Box2dAdapter&) = delete;

  AdapterDescription Describe() const override;
  void ReadBodies(BodyTable* bodies) override;
  /// At the fixtures of the last ReadBodies (or Assign, Insert).
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  void SweepContacts(const MotionView& motion, ContactTable* contacts) override;
  /// Also clears the forces (unless the world's AutoClearForces is off) and wakes the bodies.
  void Commit(const StepResult& result) override;
  BodyTransport* transport() override;

  /// Gives `body` its id before the first ReadBodies that sees it, after its fixtures were made, and what is known in double
  /// precision; poses, velocities and masses given here are written to the world as well. Throws Error if the id is negative or
  /// taken, the body has another id, or the shapes are not those of the fixtures (to 1e-4 of their size).
  void Assign(b2Body* body, std::int64_t id, const ExactBody& exact = {});

  b2Body* Find(std::int64_t id) const;                         ///< null if there is none
  std::optional<std::int64_t> IdOf(const b2Body* body) const;  ///< nothing before its first ReadBodies or Assign

  /// These set the double value and its float mirror in the world. Throw Error on an unknown id.
  void SetPose(std::int64_t id, const Pose& pose);           ///< of the centre of mass [m, rad]
  void SetVelocity(std::int64_t id, const Twist& velocity);  ///< [m/s, rad/s]; refused for a static body
  void SetGravity(Vec2 gravity);                             ///< [m/s^2]
  /// Adds to the external load of the next step [N, N m], in double precision. b2Body::ApplyForce, ApplyForceToCenter and
  /// ApplyTorque act as well, in float.
  void AddLoad(std::int64_t id, const Wrench& load);

  /// Before the first b2World::Step of the user after steps of ours: lets the world's broad phase look at all fixtures anew.
  void RefreshWorldContacts();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nscdd::box2d
