// SPDX-License-Identifier: Apache-2.0
#include "stepping/final_gap.h"

namespace nscdd {
namespace {

/// Most arms are zero, those of disks, and most walls do not turn.
Vec2 Turned(double turn, Vec2 a) { return turn == 0.0 || (a.x == 0.0 && a.y == 0.0) ? a : Rotate(turn, a); }

}  // namespace

double FinalGap(const ContactTable& t, std::size_t c, const Pose& detection_a, const Pose& detection_b, const Pose& final_a,
                const Pose& final_b, double shift_b) {
  const double turn_a = final_a.angle - detection_a.angle, turn_b = final_b.angle - detection_b.angle;
  Vec2 between = Centre(final_b) - Centre(final_a) + Vec2{shift_b, 0.0};
  if (t.has_arms()) between = between + Turned(turn_b, t.arm_b[c]) - Turned(turn_a, t.arm_a[c]);
  const double radii = t.lever_a[c] + t.lever_b[c] - t.gap[c];
  if (!t.flat[c]) return Norm(between) - radii;
  // The wall has no lever; its normal turns with it.
  const double turn = t.lever_a[c] == 0.0 ? turn_a : turn_b;
  return Dot(Turned(turn, t.normal[c]), between) - radii;
}

}  // namespace nscdd
