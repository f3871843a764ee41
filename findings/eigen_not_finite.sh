#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Eigen 3.4.0: SimplicialLDLT and SimplicialLLT report Success for matrices that are not a number or infinite; LLT does so
# although it
# exists to find what is not positive definite. The usual check of LDLT, vectorD().minCoeff() > 0, lets NaN pass unless it
# stands
# first, and infinity always: minCoeff() compares with <. SparseLU refuses NaN, not infinity.
# So: (vectorD().array() > 0).all() && vectorD().allFinite().
#
# Seen on Debian 12, libeigen3-dev 3.4.0-4 (1: accepted):
#     diag(1, nan, 1)  LDLT 1, its minCoeff() > 0 1, LLT 1, SparseLU 0
#     diag(nan, 1, 1)  LDLT 1, its minCoeff() > 0 0, LLT 1, SparseLU 0
#     diag(1, 1, inf)  LDLT 1, its minCoeff() > 0 1, LLT 1, SparseLU 1
#     diag(1, 1, -1)   LDLT 1, its minCoeff() > 0 0, LLT 0, SparseLU 1
# Exit code: 0 behaves so, 1 does not any more.
set -euo pipefail
packages=(libeigen3-dev=3.4.0-4)
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
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>
#include <cstdio>

using Matrix = Eigen::SparseMatrix<double>;
using Natural = Eigen::NaturalOrdering<int>;

int failures = 0;

void Factorise(const char* name, Eigen::Vector3d diagonal, int ldlt, int check, int llt, int lu) {
  Matrix a(3, 3);
  for (int i = 0; i < 3; ++i) a.insert(i, i) = diagonal[i];
  a.makeCompressed();
  const Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Natural> d(a);
  const Eigen::SimplicialLLT<Matrix, Eigen::Lower, Natural> l(a);
  Eigen::SparseLU<Matrix> u(a);
  const int seen[4] = {d.info() == Eigen::Success, d.vectorD().minCoeff() > 0.0, l.info() == Eigen::Success,
                       u.info() == Eigen::Success};
  std::printf("%-16s LDLT %d, its minCoeff() > 0 %d, LLT %d, SparseLU %d\n", name, seen[0], seen[1], seen[2], seen[3]);
  failures += seen[0] != ldlt || seen[1] != check || seen[2] != llt || seen[3] != lu;
}

int main() {
  std::printf("Eigen %d.%d.%d\n", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  Factorise("diag(1, nan, 1)", {1.0, NAN, 1.0}, 1, 1, 1, 0);
  Factorise("diag(nan, 1, 1)", {NAN, 1.0, 1.0}, 1, 0, 1, 0);
  Factorise("diag(1, 1, inf)", {1.0, 1.0, INFINITY}, 1, 1, 1, 1);
  Factorise("diag(1, 1, -1)", {1.0, 1.0, -1.0}, 1, 0, 0, 1);
  return failures == 0 ? 0 : 1;
}
END
g++ -std=c++17 -O2 -isystem root/usr/include/eigen3 -isystem /usr/include/eigen3 program.cpp -o program
./program
