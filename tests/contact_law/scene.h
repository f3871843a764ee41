// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <box2d/box2d.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry.h"
#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/communicator.h"
#include "nscdd/reference/reference_adapter.h"
#include "nscdd/time_stepper.h"

namespace nscdd::contact_law {

struct Material {
  double friction = 0.0;     ///< of a pair: sqrt(f1 f2)
  double restitution = 0.0;  ///< of a pair: the larger one
};

/// A free body of disks, whose centres are given from its centre of mass; density 1 kg/m^2, overlaps counted twice.
struct Grain {
  Pose pose = {};
  Twist velocity = {};
  std::vector<Circle> disks = {};
  Material material = {};
};

/// A body with a prescribed motion; shapes in its frame.
struct Wall {
  Pose pose = {};
  Twist velocity = {};
  std::vector<Line> lines = {};
  std::vector<Plane> planes = {};
  std::vector<Circle> disks = {};
  std::vector<Polygon> polygons = {};
  Material material = {};
};

/// A world of one of the platforms and the solver on it, built and read through their public interfaces. Ids are given in the
/// order of creation from 0 on.
class Scene {
 public:
  /// `period` [m] of x, from 0 on; 0: none.
  Scene(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, double period)
      : stepping_(stepping), algorithm_(algorithm), period_(period) {
    stepping_.normal_law = NormalLaw::kImpact;
  }
  virtual ~Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  std::int64_t Add(const Grain& grain);
  std::int64_t Add(const Wall& wall);
  std::int64_t AddDisk(Vec2 centre, double radius, Twist velocity = {}, Material material = {}) {
    return Add(Grain{{centre.x, centre.y, 0.0}, velocity, {{{}, radius}}, material});
  }
  std::int64_t AddLine(Vec2 a, Vec2 b, Material material = {}) { return Add(Wall{.lines = {{a, b}}, .material = material}); }
  /// The solid half-plane y <= height.
  std::int64_t AddFloor(double height = 0.0, Material material = {}) {
    return Add(Wall{.planes = {{{0.0, 1.0}, height}}, .material = material});
  }
  virtual void SetGravity(Vec2 gravity) = 0;

  const StepReport& Step(double dt);
  const StepReport& report() const { return *report_; }
  const ContactResults& contacts() { return stepper_->contacts(); }

  double period() const { return period_; }
  Pose pose(std::int64_t id) const { return after_.at(id); }
  Twist velocity(std::int64_t id) const { return velocity_.at(id); }

  const std::map<std::int64_t, Grain>& grains() const { return grains_; }
  const std::map<std::int64_t, Wall>& walls() const { return walls_; }
  /// Poses at the beginning and at the end of the last step; both the first ones before it.
  const std::map<std::int64_t, Pose>& before() const { return before_; }
  const std::map<std::int64_t, Pose>& after() const { return after_; }

 protected:
  virtual PlatformAdapter* adapter() = 0;
  virtual void Build(std::int64_t id, const Grain& grain, double mass, double inertia) = 0;
  virtual void Build(std::int64_t id, const Wall& wall) = 0;

 private:
  SteppingOptions stepping_;
  AlgorithmOptions algorithm_;
  double period_;
  SerialCommunicator communicator_;
  std::optional<TimeStepper> stepper_;
  const StepReport* report_ = nullptr;
  std::map<std::int64_t, Grain> grains_;
  std::map<std::int64_t, Wall> walls_;
  std::map<std::int64_t, Pose> before_, after_;
  std::map<std::int64_t, Twist> velocity_;
  std::int64_t next_id_ = 0;
};

class ReferenceScene final : public Scene {
 public:
  static constexpr bool kHasPolygons = false;
  /// `grain_size` [m] is Box2D's business.
  explicit ReferenceScene(double /*grain_size*/ = 1.0, const SteppingOptions& stepping = {},
                          const AlgorithmOptions& algorithm = NscdOptions{}, double period = 0.0)
      : Scene(stepping, algorithm, period), adapter_(&world_) {
    world_.period = period;
  }
  void SetGravity(Vec2 gravity) override { world_.gravity = gravity; }

 private:
  PlatformAdapter* adapter() override { return &adapter_; }
  void Build(std::int64_t id, const Grain& grain, double mass, double inertia) override;
  void Build(std::int64_t id, const Wall& wall) override;

  reference::World world_;
  reference::ReferenceAdapter adapter_;
};

/// Values in double precision by Box2dAdapter::Assign, floats in the world.
class Box2dScene final : public Scene {
 public:
  static constexpr bool kHasPolygons = true;
  /// One unit of Box2D is `grain_size` [m].
  explicit Box2dScene(double grain_size = 1.0, const SteppingOptions& stepping = {},
                      const AlgorithmOptions& algorithm = NscdOptions{}, double period = 0.0)
      : Scene(stepping, algorithm, period),
        unit_(grain_size),
        world_({0.0F, 0.0F}),
        adapter_(&world_, Options(grain_size, period)) {}
  void SetGravity(Vec2 gravity) override { adapter_.SetGravity(gravity); }

 private:
  static box2d::Box2dOptions Options(double unit, double period) {
    box2d::Box2dOptions options;
    options.metres_per_unit = unit;
    options.period = period;
    return options;
  }
  PlatformAdapter* adapter() override { return &adapter_; }
  void Build(std::int64_t id, const Grain& grain, double mass, double inertia) override;
  void Build(std::int64_t id, const Wall& wall) override;
  b2Vec2 Units(Vec2 a) const { return {static_cast<float>(a.x / unit_), static_cast<float>(a.y / unit_)}; }
  b2Body* MakeBody(b2BodyType type, const Pose& pose, const Twist& velocity);
  template <class Geometry>
  void AddShape(const b2Shape& shape, const Geometry& geometry, const Material& material, b2Body* body,
                box2d::ExactBody* exact);
  void AddCircles(const std::vector<Circle>& circles, const Material& material, b2Body* body, box2d::ExactBody* exact);

  double unit_;
  b2World world_;
  box2d::Box2dAdapter adapter_;
};

/// How deep and through what the bodies of a scene went in its last step: true geometry, pose by pose.
struct Verdict {
  double depth = 0.0;       ///< [-] deepest overlap at the end of the step, in radii of the (smaller) disk
  std::string passed;       ///< what a centre passed through on its way; empty: nothing
  double largest_turn = 0;  ///< [rad] of a free body in the step

  bool Fails() const { return depth > 1e-3 || !passed.empty(); }
};
Verdict Judge(const Scene& scene);

}  // namespace nscdd::contact_law
