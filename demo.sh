#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ./demo.sh   installs what is missing, builds, and solves 730 packed disks in a box under rotating gravity: first on one
# domain, then on two subdomains by two MPI processes. Draws a picture of each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

install_packages
echo "Building; the first time takes some minutes."
build release
nscdd=build/release/bin/nscdd
scene=sample_scenes/rotating_box_730.toml

echo
echo "1. NSCD, the reference: one domain, one process."
"$nscdd" run "$scene" --solver nscd --out results/demo_nscd

echo
echo "2. NSCDD: the same disks on two subdomains, two MPI processes."
mpirun -n 2 "$nscdd" run "$scene" --solver nscdd --subdomains 1x2 --out results/demo_nscdd

"$nscdd" render results/demo_nscd --show forces -o results/demo_forces.png
"$nscdd" render results/demo_nscdd --show multiplicity -o results/demo_multiplicity.png

cat <<END

Two pictures to look at:
  $PWD/results/demo_forces.png        force chains at the last step
  $PWD/results/demo_multiplicity.png  the disks that the two subdomains share
Numbers, step by step: results/demo_nscd/steps.csv and results/demo_nscdd/steps.csv
Next: copy a scene of sample_scenes/, change it, and run  $nscdd run YOUR_SCENE.toml
END
