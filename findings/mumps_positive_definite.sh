#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# MUMPS 5.5.1 with SYM = 1 ("symmetric positive definite") factorises indefinite matrices, and such that are not a number or
# infinite, with INFOG(1) = 0. Negative pivots are counted in INFOG(12) and nowhere else; error -40 comes from ScaLAPACK's root
# only.
# A NaN or an infinity leaves INFOG(12) = 0 too: only the solution shows it, or not even that (a column of infinity gives x =
# 0).
# So: look at INFOG(12), at the numbers before the factorisation, and at the residual of a solution.
#
# Seen on Debian 12, libmumps-5.5 5.5.1-1:
#     [1 2; 2 1]       INFOG(1) = 0, INFOG(12) = 1
#     diag(1, -1)      INFOG(1) = 0, INFOG(12) = 1
#     diag(1, NaN)     INFOG(1) = 0, INFOG(12) = 0
#     diag(1, inf)     INFOG(1) = 0, INFOG(12) = 0
#     diag(1, 0)       INFOG(1) = -10, INFOG(12) = 0
# Exit code: 0 behaves so, 1 does not any more.
set -euo pipefail
packages=(libmumps-5.5=5.5.1-1 libmumps-dev=5.5.1-1 libmumps-headers-dev=5.5.1-1)
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

cat > program.cpp <<'END'
#include <dmumps_c.h>
#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <vector>

struct Entry {
  int row, column;
  double value;
};

int failures = 0;

void Factorise(const char* name, const std::vector<Entry>& entries, int expected_1, int expected_12) {
  std::vector<MUMPS_INT> row, column;
  std::vector<double> value;
  for (const Entry& e : entries) {
    row.push_back(e.row);
    column.push_back(e.column);
    value.push_back(e.value);
  }
  DMUMPS_STRUC_C id{};
  id.comm_fortran = MPI_Comm_c2f(MPI_COMM_SELF);
  id.par = 1;
  id.sym = 1;
  id.job = -1;
  dmumps_c(&id);
  id.icntl[0] = id.icntl[1] = id.icntl[2] = -1;
  id.icntl[3] = 0;
  id.n = 2;
  id.nnz = static_cast<MUMPS_INT8>(value.size());
  id.irn = row.data();
  id.jcn = column.data();
  id.a = value.data();
  id.job = 4;
  dmumps_c(&id);
  const int code = id.infog[0], negative = id.infog[11];
  std::printf("%-16s INFOG(1) = %d, INFOG(12) = %d\n", name, code, negative);
  failures += code != expected_1 || negative != expected_12;
  id.job = -2;
  dmumps_c(&id);
}

int main() {
  MPI_Init(nullptr, nullptr);
  Factorise("[1 2; 2 1]", {{1, 1, 1.0}, {2, 1, 2.0}, {2, 2, 1.0}}, 0, 1);
  Factorise("diag(1, -1)", {{1, 1, 1.0}, {2, 2, -1.0}}, 0, 1);
  Factorise("diag(1, NaN)", {{1, 1, 1.0}, {2, 2, NAN}}, 0, 0);
  Factorise("diag(1, inf)", {{1, 1, 1.0}, {2, 2, INFINITY}}, 0, 0);
  Factorise("diag(1, 0)", {{1, 1, 1.0}, {2, 2, 0.0}}, -10, 0);
  MPI_Finalize();
  return failures == 0 ? 0 : 1;
}
END
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
lib=root/usr/lib/$(gcc -print-multiarch)
mpicxx -std=c++17 -I root/usr/include program.cpp -L "$lib" -ldmumps -lmumps_common -o program
LD_LIBRARY_PATH=$lib ./program
