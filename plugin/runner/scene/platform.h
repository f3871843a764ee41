// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "nscdd/platform_adapter.h"
#include "nscdd/vector.h"
#include "scene/body_stream.h"
#include "scene/scene.h"

namespace nscdd {

/// A host for the bodies of one rank, with its adapter. The functions are the host's user speaking, between two steps.
class Platform {
 public:
  virtual ~Platform() = default;
  virtual PlatformAdapter& adapter() = 0;
  /// Throws Error, naming the body, if its id is there already or the platform cannot hold it.
  virtual void Add(const BodyDefinition& body) = 0;
  /// [m/s^2], on free bodies, from the next step on.
  virtual void SetGravity(Vec2 gravity) = 0;
  /// Velocity of a body that this host holds; throws Error otherwise.
  virtual void SetVelocity(std::int64_t id, const Twist& velocity) = 0;
  /// Puts a body where it was, bit for bit; false if this host does not hold it.
  virtual bool Restore(std::int64_t id, const Pose& pose, const Twist& velocity) = 0;
};

/// An empty platform, "reference" or "box2d", with the scene's periodicity and units. Throws Error on any other name and when
/// the platform cannot do what the scene asks for.
std::unique_ptr<Platform> MakePlatform(const std::string& name, const Scene& scene);

std::unique_ptr<Platform> MakeReferencePlatform(const Scene& scene);
std::unique_ptr<Platform> MakeBox2dPlatform(const Scene& scene);
/// Length of a Box2D unit on that platform [m].
double Box2dMetresPerUnit(const Scene& scene);

}  // namespace nscdd
