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
  std::uint64_t grains = 0;
  std::uint64_t contacts = 0;
};

/// The text of results.xdmf: two collections in time, points "grains" and "contacts", with the columns as attributes.
std::string FormatXdmf(const std::vector<XdmfStep>& steps);

}  // namespace nscdd
