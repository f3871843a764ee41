#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Iterations, residuals and interpenetration of NSCD and NSCDD on the two rotating boxes, as a table. Deterministic but for
# seconds.
#     tests/benchmark/iterations.sh [build/release/bin/nscdd]
set -euo pipefail
cd "$(dirname "$0")/../.."
nscdd=${1:-build/release/bin/nscdd}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

row() {  # scene, label, options of the run
  local scene=$1 label=$2
  shift 2
  "$nscdd" run "sample_scenes/$scene.toml" --quiet --test-every 1 --out "$out/$scene" "$@"
  awk -F, -v scene="$scene" -v label="$label" '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { its += $at["iterations"]; nat += $at["nat"]; if ($at["max_interpenetration"] > worst) worst = $at["max_interpenetration"]
      last = $at["mean_interpenetration"]; if ($at["status"] != "converged") ++failed }
    END { printf "| %-29s | %-31s | %6.1f | %.1e | %.1e | %.1e | %d |\n",
                 scene, label, its / (NR - 1), nat / (NR - 1), last, worst, failed }
  ' "$out/$scene/steps.csv"
}

echo "| scene | solver, criterion | iterations a step | mean nat | final mean interpenetration [m] | largest [m] |" \
     "not converged |"
echo "| --- | --- | --- | --- | --- | --- | --- |"
for scene in rotating_box_730 rotating_box_730_frictionless; do
  qm16=(--criterion qm16 --tolerance 1.666e-4 --acceleration none)
  row $scene "nscd, qm16" --solver nscd "${qm16[@]}"
  row $scene "nscdd 1x2, qm16" --solver nscdd --subdomains 1x2 "${qm16[@]}"
  for acceleration in none anderson; do
    for grid in 1x1 1x2 4x4 8x8; do
      row $scene "nscdd $grid, nat 1e-4, $acceleration" --solver nscdd --subdomains $grid --criterion nat --tolerance 1e-4 \
        --acceleration $acceleration
    done
  done
done
