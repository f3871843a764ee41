// SPDX-License-Identifier: Apache-2.0
#include "bare_sweep.h"

#include <algorithm>

namespace nscdd::benchmark {

void BareSweep(const std::vector<NormalRow>& rows, const double* inverse_mass, double* velocity, double* impulse) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const NormalRow& c = rows[k];
    double* va = velocity + 2 * c.a;
    double* vb = velocity + 2 * c.b;
    const double vn = c.n.x * (vb[0] - va[0]) + c.n.y * (vb[1] - va[1]);
    const double rn = std::max(0.0, impulse[k] - c.inverse_wnn * (vn + c.offset));
    const double dn = rn - impulse[k];
    impulse[k] = rn;
    const double ma = inverse_mass[c.a], mb = inverse_mass[c.b];
    va[0] -= ma * (c.n.x * dn);
    va[1] -= ma * (c.n.y * dn);
    vb[0] += mb * (c.n.x * dn);
    vb[1] += mb * (c.n.y * dn);
  }
}

void BareSweep(const std::vector<FrictionRow>& rows, const double* inverse_mass, double* velocity, double* impulse) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const FrictionRow& c = rows[k];
    double* va = velocity + 3 * c.a;
    double* vb = velocity + 3 * c.b;
    double* r = impulse + 2 * k;
    const double dx = vb[0] - va[0], dy = vb[1] - va[1];
    const double vn = c.n.x * dx + c.n.y * dy;
    const double vt = c.n.y * dx - c.n.x * dy + c.turn_tb * vb[2] - c.turn_ta * va[2];
    const double rn = std::max(0.0, r[0] - c.inverse_wnn * (vn + c.offset));
    const double bound = c.friction * rn;
    const double rt = std::min(bound, std::max(-bound, r[1] - c.inverse_wtt * vt));
    const double dn = rn - r[0], dt = rt - r[1];
    r[0] = rn;
    r[1] = rt;
    const double* ia = inverse_mass + 2 * c.a;
    const double* ib = inverse_mass + 2 * c.b;
    const double px = c.n.x * dn + c.n.y * dt, py = c.n.y * dn - c.n.x * dt;
    va[0] -= ia[0] * px;
    va[1] -= ia[0] * py;
    va[2] -= ia[1] * (c.turn_ta * dt);
    vb[0] += ib[0] * px;
    vb[1] += ib[0] * py;
    vb[2] += ib[1] * (c.turn_tb * dt);
  }
}

}  // namespace nscdd::benchmark
