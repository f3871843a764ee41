// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace nscdd {

struct Material {
  std::string name;
  double density = 1.0;      ///< [kg/m^2]
  double friction = 0.3;     ///< [-] Coulomb coefficient; the platform combines the two of a pair
  double restitution = 0.0;  ///< [-] Newton coefficient
};

}  // namespace nscdd
