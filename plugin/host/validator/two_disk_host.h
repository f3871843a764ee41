// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "nscdd_plugin.h"

namespace nscdd {

/// The smallest platform: two equal disks, no walls, no loads, behind the C table. They approach each other along x, meet
/// centrally without restitution and then stay where they are.
class TwoDiskHost {
 public:
  static constexpr double kRadius = 0.5;  // [m]
  static constexpr double kMass = 2.0;    // [kg]

  explicit TwoDiskHost(double speed = 1.0) : velocity_{speed, 0.0, 0.0, -speed, 0.0, 0.0} {}

  /// Valid as long as this object stays where it is.
  const nscdd_host* table();

  std::array<double, 6> pose() const { return pose_; }
  std::array<double, 6> velocity() const { return velocity_; }
  int commits() const { return commits_; }
  double gap() const;  ///< [m]

  /// The function of that name fails with this sentence; "" none.
  void FailIn(std::string function, std::string sentence);
  /// The velocity of the second disk becomes this.
  void SetSecondSpeed(double vx) { velocity_[3] = vx; }

 private:
  struct Functions;
  std::int32_t Result(const char* function);
  void Show(double distance, double dx, double dy, const double* pose, nscdd_contacts* contacts);

  nscdd_host table_{};
  std::array<double, 6> pose_{-1.02, 0.0, 0.0, 1.02, 0.0, 0.0};
  std::array<double, 6> velocity_;
  int commits_ = 0;
  std::string failing_, sentence_, last_error_;
  std::int32_t row_a_ = 0, row_b_ = 1;
  double detected_gap_ = 0.0, lever_ = 0.0;
  std::array<double, 2> normal_{1.0, 0.0}, site_{};
};

}  // namespace nscdd
