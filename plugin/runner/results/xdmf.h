// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nscdd {

/// A step in results.h5, as ParaView is told of it.
struct XdmfStep {
  std::string group;  ///< for instance /steps/000050
  double time = 0.0;
  bool has_disks = false;    ///< grains are drawn from the table "disks", not "grains"
  std::uint64_t grains = 0;  ///< points
  std::uint64_t contacts = 0;
  std::uint64_t walls = 0;  ///< lines
  std::uint64_t wall_points = 0;
};

/// The text of results.xdmf: collections in time of points "grains" and "contacts" and of lines "chains" and "walls", with the
/// columns as attributes.
std::string FormatXdmf(const std::vector<XdmfStep>& steps);

}  // namespace nscdd
