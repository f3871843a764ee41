#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Siconos 4.4.0, 2D friction, one contact: W = diag(2, 3), q = (-1, 0.3), friction 0.01, 0.02, ... 1. It has one solution each,
# r = (1/2, -min(1/10, mu / 2)). With default options
# - ENUM, which goes through all cases of sticking, sliding and opening, ends with info = 1 and without the solution for two of
# the
#   hundred;
# - CPG has the solution for all, yet says that it has not (info != 0) for 29;
# - LEMKE and NSGS find all.
# So: judge an answer by a residual of your own, and do not take ENUM for a reference.
#
# Seen on Debian 12, libsiconos-numerics7 4.4.0+dfsg-2:
#     ENUM: info != 0 for 2, wrong r for 2 of 100
#     CPG: info != 0 for 29, wrong r for 0 of 100
#     LEMKE: info != 0 for 0, wrong r for 0 of 100
#     NSGS: info != 0 for 0, wrong r for 0 of 100
# Exit code: 0 behaves so, 1 does not any more.
set -euo pipefail
packages=(libsiconos-numerics7=4.4.0+dfsg-2 libsiconos-numerics-dev=4.4.0+dfsg-2)
# The packages as installed, else downloaded and unpacked below a temporary folder; nothing is installed.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/root"
for pinned in "${packages[@]}"; do
  name=${pinned%%=*} version=${pinned#*=}
  if [[ $(dpkg-query --show --showformat='${Version}' "$name" 2>/dev/null) == "$version" ]]; then continue; fi
  (cd "$folder" && apt-get download -qq "$pinned" && dpkg -x "$name"_*.deb root)
done
cd "$folder"

cat > program.c <<'END'
#include <math.h>
#include <siconos/numerics/FrictionContactProblem.h>
#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/SolverOptions.h>
#include <stdio.h>

static int Solve(int solver, double mu, double r[2]) {
  double q[2] = {-1.0, 0.3}, u[2] = {0.0, 0.0};
  NumericsMatrix* w = NM_create(NM_DENSE, 2, 2);
  w->matrix0[0] = 2.0;
  w->matrix0[1] = w->matrix0[2] = 0.0;
  w->matrix0[3] = 3.0;
  r[0] = r[1] = 0.0;
  return fc2d_driver(frictionContactProblem_new_with_data(2, 1, w, q, &mu), r, u, solver_options_create(solver));
}

static int Differs(const char* name, int solver, int expected_info, int expected_wrong) {
  int info = 0, wrong = 0;
  for (int k = 1; k <= 100; ++k) {
    double r[2];
    const double mu = k / 100.0;
    info += Solve(solver, mu, r) != 0;
    wrong += !(fabs(r[0] - 0.5) + fabs(r[1] + fmin(0.1, 0.5 * mu)) < 1e-6);
  }
  printf("%s: info != 0 for %d, wrong r for %d of 100\n", name, info, wrong);
  return info != expected_info || wrong != expected_wrong;
}

int main(void) {
  int differs = Differs("ENUM", SICONOS_FRICTION_2D_ENUM, 2, 2);
  differs += Differs("CPG", SICONOS_FRICTION_2D_CPG, 29, 0);
  differs += Differs("LEMKE", SICONOS_FRICTION_2D_LEMKE, 0, 0);
  differs += Differs("NSGS", SICONOS_FRICTION_2D_NSGS, 0, 0);
  return differs == 0 ? 0 : 1;
}
END
lib=root/usr/lib/$(gcc -print-multiarch)
gcc -I root/usr/include/siconos -I root/usr/include/siconos/numerics -I root/usr/include -isystem /usr/include/siconos \
    -isystem /usr/include/siconos/numerics program.c -L "$lib" -lsiconos_numerics -lm -o program
LD_LIBRARY_PATH=$lib ./program
