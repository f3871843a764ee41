// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "body_store.h"
#include "broad_phase.h"
#include "narrow_phase.h"
#include "nscdd/platform_adapter.h"
#include "pair_filter.h"

namespace nscdd::box2d {

/// Every contact within an alert distance at given poses, or within the reaches of bodies on their way. What it keeps between
/// calls makes it fast, and changes no result.
class ContactFinder {
 public:
  ContactFinder(BodyStore* store, double period, double period_origin)
      : store_(store), period_(period), period_origin_(period_origin) {}

  void Detect(const PoseView& poses, double alert, const PairFilter& filter, ContactTable* contacts);
  void Sweep(const MotionView& motion, const PairFilter& filter, ContactTable* contacts);

 private:
  void Find(const PairFilter& filter, ContactTable* contacts);
  void CheckPoses(const PoseView& poses) const;
  void CheckPeriod() const;
  void PlaceBodies(const PoseView& poses);
  void PlaceMotion(const MotionView& motion);
  void PlaceShapes(std::int32_t slot);
  bool NeedsRestart(double alert) const;
  void UpdateBoxes();
  Box BoxOf(std::int32_t shape, double margin) const;
  void UpdateCandidates();
  void AddCandidate(const Overlap& overlap);
  void SortCandidates();

  BodyStore* store_;
  double period_;
  double period_origin_;
  BroadPhase broad_phase_;
  Placement placement_;
  double half_extent_ = 0.0;  // [m] of the domain of free bodies and its middle
  Vec2 middle_;
  double alert_ = 0.0;  // [m] twice the smallest reach
  double alert_of_start_ = 0.0;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> sorted_;
  std::vector<std::uint32_t> first_;
  NarrowPhase narrow_phase_;
};

}  // namespace nscdd::box2d
