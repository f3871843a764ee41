// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "nscdd/platform_adapter.h"
#include "nscdd/reference/world.h"

namespace nscdd::reference {

class ContactDetector;

/// Binds the solver to a World: all in double, candidate pairs by a cell grid, O(number of disks).
///
/// Particular cases that the contract leaves open: disks with coincident centres get the normal (0, 1); a disk whose centre
/// lies on a segment gets the normal to the left of a -> b. Where segments of one body share an end point, a disk in front of
/// the flat side of one of them meets no corner there, and a disk in front of none meets the corner once (on the segment
/// with the smallest number). A periodic world must be longer than each free body's diameter plus the alert distance, its
/// segments must not exceed one period in x, its half-planes must be horizontal.
class ReferenceAdapter final : public PlatformAdapter {
 public:
  /// Keeps the pointer; the world must outlive the adapter. Throws Error on a period that is negative or not finite.
  explicit ReferenceAdapter(World* world);
  ~ReferenceAdapter() override;

  AdapterDescription Describe() const override;
  /// Checks what the world's user may have edited; throws Error that names the body.
  void ReadBodies(BodyTable* bodies) override;
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  void SweepContacts(const MotionView& motion, ContactTable* contacts) override;
  void Commit(const StepResult& result) override;
  BodyTransport* transport() override;

 private:
  class Transport;
  World* world_;
  std::unique_ptr<Transport> transport_;
  std::unique_ptr<ContactDetector> detector_;
};

}  // namespace nscdd::reference
