// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body_store.h"
#include "nscdd/contact_table.h"
#include "pair_filter.h"
#include "wall.h"

namespace nscdd::box2d {

/// A pair worth a closer look; A has the smaller body id. In wrapped coordinates B is seen near A when shifted by `shift`
/// periods.
struct Candidate {
  std::int32_t a;
  std::int32_t b;
  std::int32_t shift;
};

/// Where a body is in this detection.
struct BodyPlace {
  Vec2 centre;          // as given
  double cosine = 1.0;  // left alone for bodies that look the same at every angle
  double sine = 0.0;
  std::int32_t row = -1;
};

/// Where a shape is.
struct ShapePlace {
  Vec2 centre;             // of the disk, else of the wall's body; as given
  double radius = 0.0;     // of the disk, else 0
  std::int32_t row = -1;   // of the body
  std::int32_t wraps = 0;  // periods that were taken off to come into the period
};

/// Where everything is in this detection.
struct Placement {
  std::vector<BodyPlace> bodies;   // by slot
  std::vector<ShapePlace> shapes;  // by shape
  double period = 0.0;
  double slack = 0.0;  // [m] rounding of positions

  const BodyPlace& body(std::int32_t slot) const { return bodies[static_cast<std::size_t>(slot)]; }
  const ShapePlace& shape(std::int32_t index) const { return shapes[static_cast<std::size_t>(index)]; }
};

/// Gap, frame, levers and arms of candidates, in double precision.
class NarrowPhase {
 public:
  /// Candidates in order of their keys; writes those within `alert` in the same order.
  void Run(const BodyStore& store, const Placement& placement, const PairFilter& filter, std::span<const Candidate> candidates,
           double alert, ContactTable* contacts);

 private:
  /// A disk within the alert distance of a wall.
  struct Hit {
    const Candidate* candidate;
    WallPoint closest;  // world axes, from the centre of the wall's body
    bool wall_is_a;
  };

  void TestDisks(const Candidate& candidate);
  /// All candidates of the same two bodies, one at least with a wall.
  void TestRun(std::span<const Candidate> run);
  void TestWall(const Candidate& candidate);
  bool IsTaken(std::size_t hit) const;
  bool HasEndAt(const Hit& hit, Vec2 corner, double tolerance) const;
  void EmitWall(const Hit& hit);
  void EmitHead(const Candidate& candidate, Vec2 normal, double gap);
  void EmitArms(Vec2 arm_a, Vec2 arm_b);
  std::int32_t Image(const Candidate& candidate) const;
  Vec2 ArmOf(std::int32_t shape) const;
  double JoinTolerance(double radius) const { return 1e-9 * radius + placement_->slack; }

  const BodyStore* store_ = nullptr;
  const Placement* placement_ = nullptr;
  const PairFilter* filter_ = nullptr;
  ContactTable* contacts_ = nullptr;
  double alert_ = 0.0;
  bool has_arms_ = false;
  std::vector<Hit> hits_;
};

}  // namespace nscdd::box2d
