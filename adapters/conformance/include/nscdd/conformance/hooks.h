// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "nscdd/platform_adapter.h"

namespace nscdd::conformance {

/// A disk that the platform is asked for. Radii are multiples of 1/1024 m and coefficients are dyadic, exact in float too.
struct DiskSpec {
  std::int64_t id = 0;  ///< wished for; a platform that numbers its bodies itself may take another
  BodyKind kind = BodyKind::kFree;
  Vec2 centre;
  double radius = 0.5;   ///< [m]
  double density = 1.0;  ///< [kg/m^2]: mass pi r^2 density, inertia m r^2 / 2
  Twist velocity;        ///< of a prescribed disk too, if the adapter declares prescribed_motion
  double friction = 0.0;
  double restitution = 0.0;
};

/// One free rigid body of several disks, all in the world frame, angle 0. Mass and inertia are sums over the disks.
struct ClusterSpec {
  struct Member {
    Vec2 centre;
    double radius;
  };
  std::int64_t id = 0;
  std::vector<Member> disks;
  double density = 1.0;
};

/// A fixed polyline in the world frame, touched on its left side at least (to the left of points[0] -> points[1]).
struct PolylineSpec {
  std::int64_t id = 0;
  std::vector<Vec2> points;
  double friction = 0.0;
  double restitution = 0.0;
};

/// A fixed half-plane through `point`; the normal leads to the free side.
struct HalfPlaneSpec {
  std::int64_t id = 0;
  Vec2 point;
  Vec2 normal;
  double friction = 0.0;
  double restitution = 0.0;
};

/// What a body looks like to a user of the platform who never heard of the solver.
struct BodyState {
  Pose pose;  ///< of the centre of mass
  Twist velocity;
};

/// A fresh, empty world of the platform under test, and an adapter bound to it; what an implementer writes.
/// Pairs of bodies: friction sqrt(f1 f2) or anything equal to it for f1 = f2; restitution likewise.
class Host {
 public:
  virtual ~Host() = default;

  virtual PlatformAdapter* adapter() = 0;
  /// Relative rounding of the platform's own numbers: 0 if it keeps doubles, 1.2e-7 if it keeps floats.
  virtual double precision() const = 0;

  /// These return the id under which the adapter reports the new body; nullopt: the platform has no such thing.
  virtual std::int64_t AddDisk(const DiskSpec& spec) = 0;
  virtual std::optional<std::int64_t> AddCluster(const ClusterSpec& spec) = 0;
  virtual std::optional<std::int64_t> AddPolyline(const PolylineSpec& spec) = 0;
  virtual std::optional<std::int64_t> AddHalfPlane(const HalfPlaneSpec& spec) = 0;
  /// Makes the platform's filters keep the two bodies apart. False: it has no filters.
  virtual bool NeverTouch(std::int64_t one, std::int64_t other) = 0;

  virtual void SetGravity(Vec2 gravity) = 0;
  /// As the platform's user reads it, not through the adapter.
  virtual BodyState Read(std::int64_t id) = 0;
  /// As the platform's user edits it, not through the adapter.
  virtual void Move(std::int64_t id, const Pose& pose) = 0;
  virtual void Remove(std::int64_t id) = 0;
};

/// Makes one. `period` [m] is the length of the periodic direction x, from x = 0; 0: none. Null: no such period here.
using HostFactory = std::function<std::unique_ptr<Host>(double period)>;

/// The program of a conformance test:
///   (nothing)      runs all checks        --check NAME  runs one        --list  prints their names
///   --seed S       of the random checks   --broken      breaks the adapter on purpose: the check must then fail
/// Returns 0: passed, 1: failed, 77: skipped because the adapter does not declare the capability, 2: wrong arguments.
int Main(int argc, char** argv, const HostFactory& factory);

}  // namespace nscdd::conformance
