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
#include "wall_contacts.h"

namespace nscdd::reference {

/// Finds the contacts of a world at given poses. What it keeps between calls is memory, never knowledge.
class ContactDetector {
 public:
  void Detect(const World& world, const PoseView& poses, double alert, ContactTable* contacts);

 private:
  /// What a row of the pose table says about pairs.
  struct Row {
    Filter filter;
    bool is_free;
    double friction;
    double restitution;
  };
  struct PlacedDisk {
    Vec2 centre;  // world frame
    Vec2 arm;     // from the body's centre of mass, world axes
    double radius;
    std::int32_t row;
    std::int32_t shape;
  };
  /// Two shapes within the alert distance; indices into disks_, or -1 - index into walls_.
  struct Candidate {
    std::int32_t a, b;
    std::int32_t shape_a, shape_b;
    std::int32_t image;
    std::int32_t index_a, index_b;
  };
  /// Disks whose radii are within a factor of two.
  struct SizeClass {
    double max_radius = 0.0;
    std::vector<GridEntry> entries;
    CellGrid grid;
  };
  struct WallHit {
    std::int32_t disk;
    std::int32_t wall;
    std::int32_t image;  // of the wall, seen from the disk where it is
    SegmentPoint closest;
  };

  void PlaceShapes(const World& world, const PoseView& poses);
  void PlaceWalls(const Body& body, const Pose& q, std::int32_t row);
  void CheckPeriod(const World& world, double alert) const;
  void FillClasses(double alert);
  void AddEntry(SizeClass* size_class, std::int32_t disk, double alert) const;
  void FindDiskPairs(double alert);
  void AddDiskPair(const GridEntry& one, const GridEntry& other, double alert);
  void FindWallPairs(double alert);
  void FindHalfPlanePairs(const PlacedWall& wall, std::int32_t index, double alert);
  void FindSegmentHits(const PlacedWall& wall, std::int32_t index, double alert);
  void AddSegmentPairs();
  bool IsTaken(const WallHit& hit, std::span<const WallHit> of_disk) const;
  void AddWallPair(std::int32_t disk, std::int32_t wall, std::int32_t image);
  bool Touchable(std::int32_t row, std::int32_t other) const;
  void SortCandidates();
  /// Ends of segments closer than this [m] are one point: rounding at the disk's place, and a little of the disk.
  double JoinTolerance(const PlacedDisk& disk) const;
  void FillTable(ContactTable* contacts) const;
  void FillDiskPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const;
  void FillWallPair(const Candidate& candidate, std::size_t i, ContactTable* contacts) const;

  double period_ = 0.0;
  double period_origin_ = 0.0;
  double slack_ = 0.0;  // [m] rounding of wrapped coordinates
  double largest_radius_ = 0.0;
  std::vector<Row> rows_;
  std::vector<PlacedDisk> disks_;
  std::vector<PlacedWall> walls_;
  std::map<int, SizeClass> classes_;  // by log2 of the largest radius over the class's
  std::vector<WallHit> hits_;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> sorted_;
  std::vector<std::size_t> first_;
};

}  // namespace nscdd::reference
