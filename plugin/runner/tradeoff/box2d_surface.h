// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "nscdd/platform_adapter.h"

namespace nscdd {

/// Contacts as Box2D's own solver sees them, for measuring its answers: everything but DetectContacts() is the adapter's.
///
/// Box2D 2.4 gives an edge or a polygon a skin of b2_polygonRadius (0.01 units) and lets it touch what the skin touches; a
/// circle has none beyond its radius. b2WorldManifold puts the contact half-way between the two surfaces. Hence, with s the
/// skin of the wall and g the gap between the shapes as drawn:
///
///     pair            gap      lever of the disk   lever of the wall
///     disk, disk      g        r + g/2             r' + g/2            as in ContactTable
///     disk, edge      g - s    r + (g - s)/2       s + (g - s)/2       flat side and end alike
///     disk, polygon   g - s    r + (g - s)/2       s + (g - s)/2       likewise
///
/// b2_linearSlop (0.005 units) is no part of the surface: impulses begin where the gap above is 0, and position iterations only
/// undo what overlaps by more than the slop. A pair at rest, of whichever kind, therefore has a gap from -slop to 0; seen from
/// the edge as drawn a resting disk floats 0.005 to 0.01 units above it, and its weight would be a force across a gap. The slop
/// stays in the measured interpenetration: disks do overlap by it.
class Box2dSurface final : public PlatformAdapter {
 public:
  using ShapeName = std::pair<std::int64_t, std::int32_t>;  ///< id of the body, number of the shape
  /// `skins` [m]: of the shapes that have one.
  Box2dSurface(PlatformAdapter* adapter, std::map<ShapeName, double> skins);

  AdapterDescription Describe() const override { return adapter_->Describe(); }
  void ReadBodies(BodyTable* bodies) override { adapter_->ReadBodies(bodies); }
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  void Commit(const StepResult& result) override { adapter_->Commit(result); }
  BodyTransport* transport() override { return adapter_->transport(); }

 private:
  double SkinOf(std::int64_t id, std::int32_t shape) const;

  PlatformAdapter* adapter_;
  std::map<ShapeName, double> skins_;
  double thickest_ = 0.0;
};

}  // namespace nscdd
