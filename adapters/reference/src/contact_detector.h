// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "cell_grid.h"
#include "nscdd/platform_adapter.h"
#include "nscdd/reference/world.h"
#include "nscdd/sweep.h"
#include "wall_contacts.h"

namespace nscdd::reference {

/// Finds the contacts of a world at given poses. What it keeps between calls is memory, never knowledge.
class ContactDetector {
 public:
  /// Pairs within the reaches at the beginning of the motion, each at the moment at which its shapes meet on their way.
  void Sweep(const World& world, const MotionView& motion, ContactTable* contacts);
  /// Pairs within `alert` where they are.
  void Detect(const World& world, const PoseView& poses, double alert, ContactTable* contacts);

 private:
  /// What a row of the pose table says about pairs.
  struct Row {
    Filter filter;
    bool is_free;
    double friction;
    double restitution;
    double reach;       // [m]
    Vec2 move;          // [m] over the step
    double turn = 0.0;  // [rad] over the step
  };
  struct PlacedDisk {
    Vec2 centre;  // world frame
    Vec2 arm;     // from the body's centre of mass, world axes
    double radius;
    std::int32_t row;
    std::int32_t shape;
  };
  /// Where a disk and a wall meet.
  struct WallMeeting {
    double moment = 0.0;
    SweptDisk way;      // of the disk, from the centre of the wall's body
    Vec2 seen;          // centre of the disk at the beginning, as the wall sees it
    WallPoint closest;  // at the moment, in the axes that the wall has at the beginning

    /// The disk's centre at another moment, in these axes.
    Vec2 SeenAt(double t, const PlacedWall& wall) const { return t == 0.0 ? seen : wall.centre + way.At(t); }
  };
  /// Two shapes within reach of each other; indices into disks_, or -1 - index into walls_.
  struct Candidate {
    std::int32_t a, b;
    std::int32_t shape_a, shape_b;
    std::int32_t image;
    std::int32_t index_a, index_b;
    std::int32_t meeting = -1;  // index into meetings_, of a wall
  };
  /// Disks whose radii are within a factor of two.
  struct SizeClass {
    double max_radius = 0.0;
    std::vector<GridEntry> entries;
    CellGrid grid;
  };
  /// A disk and a segment within reach of each other.
  struct WallHit {
    std::int32_t disk;
    std::int32_t wall;
    std::int32_t image;  // of the wall, seen from the disk where it is
    WallMeeting meeting;
    bool is_taken = false;
  };

  void Find(const World& world, const PoseView& poses, ContactTable* contacts);
  void PlaceShapes(const World& world, const PoseView& poses);
  void PlaceWalls(const Body& body, const Pose& q, std::int32_t row);
  void CheckPeriod(const World& world) const;
  void FillClasses();
  void AddEntry(SizeClass* size_class, std::int32_t disk, double radius) const;
  Row RowOf(const Body& body, std::size_t row) const;
  void FindDiskPairs();
  void AddDiskPair(const GridEntry& one, const GridEntry& other);
  void FindWallPairs();
  void FindHalfPlanePairs(const PlacedWall& wall, std::int32_t index);
  void FindSegmentHits(const PlacedWall& wall, std::int32_t index);
  void AddSegmentPairs();
  void Yield(WallHit* hit, std::span<const WallHit> of_disk) const;
  bool IsJoined(const PlacedWall& wall, const PlacedWall& other, Vec2 corner, double tolerance) const;
  void AddWallPair(std::int32_t disk, std::int32_t wall, std::int32_t image, const WallMeeting& meeting);
  double ReachOf(std::int32_t row, std::int32_t other) const;
  /// The way of the disk, whose centre is `seen` by the wall at the beginning, and where it meets the wall.
  WallMeeting MeetingOf(const PlacedDisk& disk, const PlacedWall& wall, Vec2 seen, double tolerance) const;
  bool Touchable(std::int32_t row, std::int32_t other) const;
  void SortCandidates();
  /// Ends of segments closer than this [m] are one point: rounding at the disk's place, and a little of the disk.
  double JoinTolerance(const PlacedDisk& disk) const;
  void FillTable(ContactTable* contacts) const;
  void FillDiskPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const;
  double MeetingOf(const PlacedDisk& a, const PlacedDisk& b, Vec2 between) const;
  void FillWallPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const;

  double period_ = 0.0;
  double period_origin_ = 0.0;
  double slack_ = 0.0;                  // [m] rounding of wrapped coordinates
  double largest_ = 0.0;                // [m] radius and reach of a disk
  double alert_ = 0.0;                  // [m] half of it: the reach of every body where they stand still
  const MotionView* motion_ = nullptr;  // null: they do
  std::span<const double> reach_;
  std::vector<Row> rows_;
  std::vector<PlacedDisk> disks_;
  std::vector<PlacedWall> walls_;
  std::map<int, SizeClass> classes_;  // by log2 of the largest radius over the class's
  std::vector<WallHit> hits_;
  std::vector<WallMeeting> meetings_;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> sorted_;
  std::vector<std::size_t> first_;
};

}  // namespace nscdd::reference
