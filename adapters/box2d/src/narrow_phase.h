// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body_store.h"
#include "nscdd/contact_table.h"
#include "nscdd/sweep.h"
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
  double reach = 0.0;  // [m]
  Vec2 move;           // [m] over the step
  double turn = 0.0;   // [rad] over the step
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
  bool is_swept = false;  // bodies are on their way, else where they are
  double slack = 0.0;     // [m] rounding of positions

  const BodyPlace& body(std::int32_t slot) const { return bodies[static_cast<std::size_t>(slot)]; }
  const ShapePlace& shape(std::int32_t index) const { return shapes[static_cast<std::size_t>(index)]; }
};

/// Gap, frame, levers and arms of candidates, in double precision.
class NarrowPhase {
 public:
  /// Candidates in order of their keys; writes those within reach, where they meet, in the same order.
  void Run(const BodyStore& store, const Placement& placement, const PairFilter& filter, std::span<const Candidate> candidates,
           ContactTable* contacts);

 private:
  /// A disk within reach of a wall. World axes that turn with the wall, from the centre of its body.
  struct Hit {
    const Candidate* candidate = nullptr;
    bool wall_is_a = false;
    std::int32_t disk = -1, wall = -1;  // shapes
    Vec2 seen;                          // the disk's centre at the beginning
    SweptDisk way;
    double moment = 0.0;
    WallPoint closest;  // at the moment
    bool is_taken = false;
  };

  void TestDisks(const Candidate& candidate);
  double MeetingOf(const Candidate& candidate, Vec2 between) const;
  void TestWall(const Candidate& candidate);
  void Meet(Hit* hit) const;
  WallPoint ClosestAt(const Hit& hit, Vec2 seen) const;
  Vec2 SeenAt(const Hit& hit, double moment) const { return moment == 0.0 ? hit.seen : hit.way.At(moment); }
  void YieldAtJoints();
  void Yield(Hit* hit, std::span<Hit* const> of_disk) const;
  bool IsJoined(const Hit& hit, const Hit& other, Vec2 corner, double tolerance) const;
  bool RisesFrom(const Hit& hit, Vec2 normal) const;
  bool HasEndAt(const Hit& hit, Vec2 corner, double tolerance) const;
  double ShiftOf(const Hit& hit) const;
  double ReachOf(const Candidate& candidate) const;
  void EmitWall(const Hit& hit);
  Vec2 ArmAt(std::int32_t shape, double moment) const;
  void EmitHead(const Candidate& candidate, Vec2 normal, double gap, double moment);
  void EmitArms(Vec2 arm_a, Vec2 arm_b);
  std::int32_t Image(const Candidate& candidate) const;
  Vec2 ArmOf(std::int32_t shape) const;
  double JoinTolerance(double radius) const { return 1e-9 * radius + placement_->slack; }

  const BodyStore* store_ = nullptr;
  const Placement* placement_ = nullptr;
  const PairFilter* filter_ = nullptr;
  ContactTable* contacts_ = nullptr;
  bool has_arms_ = false;
  std::vector<Hit> hits_;  // in the order of the candidates
  std::vector<Hit*> by_disk_;
};

}  // namespace nscdd::box2d
