#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Whether two builds compute the same bits: runs the sample scenes, shortened, with both programs and compares final.csv and
# steps.csv without its seconds (results.h5 carries times of its own); solves single problems with both. Two minutes on two
# cores.
#     tests/benchmark/same_bits.sh OLD_NSCDD NEW_NSCDD        (each takes the plugin of its own build)
# Ends with 1 if a case differs. Same compiler, flags and machine: otherwise differences say nothing.
set -uo pipefail
[[ $# -eq 2 ]] || { sed -n 's/^#     /usage: /p' "$0" >&2; exit 2; }
old=$(realpath "$1") new=$(realpath "$2")
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1
cases=0 differing=0

without_seconds() {  # steps.csv
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) keep[i] = $i !~ /^seconds_/ }
           { line = ""; for (i = 1; i <= NF; ++i) if (keep[i]) line = line "," $i; print line }' "$1"
}

verdict() {  # 0: same, label
  ((++cases))
  (( $1 == 0 )) && return
  ((++differing))
  echo "differs: $2"
}

compare() {  # ranks, scene, options of the run
  local ranks=$1 scene=$2 label="$*" launcher=()
  shift 2
  (( ranks > 1 )) && launcher=(mpirun -n "$ranks")
  rm -rf "$work/old" "$work/new"
  local run=(run "sample_scenes/$scene.toml" --quiet "$@")
  "${launcher[@]}" "$old" "${run[@]}" --out "$work/old" >"$work/old.log" 2>&1 &
  "${launcher[@]}" "$new" "${run[@]}" --out "$work/new" >"$work/new.log" 2>&1
  wait $!
  if [[ ! -s $work/old/final.csv ]]; then
    echo "the old program failed: $label"; tail -n 2 "$work/old.log"; verdict 1 "$label"; return
  fi
  cmp -s "$work/old/final.csv" "$work/new/final.csv" &&
    cmp -s <(without_seconds "$work/old/steps.csv") <(without_seconds "$work/new/steps.csv")
  verdict $? "$label"
}

compare_solve() {  # scene, step, options of the solver
  local scene=$1 label="solve $*" step=$2
  shift 2
  "$old" export "sample_scenes/$scene.toml" --step "$step" --json "$work/problem.json" >"$work/old.log" 2>&1
  "$old" solve "$work/problem.json" "$@" 2>&1 | grep -v seconds >"$work/old.txt"
  "$new" solve "$work/problem.json" "$@" 2>&1 | grep -v seconds >"$work/new.txt"
  grep -q V_end "$work/old.txt" && cmp -s "$work/old.txt" "$work/new.txt"
  verdict $? "$label"
}

nscdd=(--solver nscdd --subdomains 2x2)
fea=(--solver fea --subdomains 2x2)
for scene in two_disks column pyramid incline_roll; do
  compare 2 $scene --steps 20 "${nscdd[@]}"
  compare 1 $scene --steps 20 "${fea[@]}"
done
for scene in clusters drum sloped_flow_750 rotating_box_730 rotating_box_730_frictionless; do
  compare 1 $scene --steps 20 --solver nscd
  compare 1 $scene --steps 20 "${nscdd[@]}"
  compare 2 $scene --steps 20 "${nscdd[@]}"
  compare 1 $scene --steps 12 "${fea[@]}"
  compare 2 $scene --steps 6 "${fea[@]}" --interface cg --option compatibility=full
done
for scene in clusters sloped_flow_750 rotating_box_730 rotating_box_730_frictionless; do
  for ranks in 1 2; do
    compare $ranks $scene --steps 6 --solver rea --subdomains 1x2 --max-iterations 2000
    compare $ranks $scene --steps 6 --solver iea --subdomains 2x2 --option polish_sweeps=2 --max-iterations 500
  done
  compare 1 $scene --steps 6 --solver iea --subdomains 2x2 --option closing_updates=5 --max-iterations 100
  compare 2 $scene --steps 8 "${nscdd[@]}" --option normal_law=feedback
  compare 2 $scene --steps 8 "${nscdd[@]}" --option normal_law=strict
  compare 3 $scene --steps 8 --solver nscdd --subdomains 3x2 --adapter reference
  compare 1 $scene --steps 8 --solver nscdd --subdomains 3x2 --acceleration none --criterion qm16 --option sweeps_per_stage=3
done
compare 1 pyramid --steps 3 --solver newton
compare 1 rotating_box_730 --steps 6 --cold --solver nscd --criterion nat_max --tolerance 1e-2
compare 2 rotating_box_730 --steps 6 "${fea[@]}" --option compatibility=sticking \
  --option status_compatibility=normal --option repartition_every=3
compare 2 rotating_box_730 --steps 4 "${fea[@]}" --option linear_solver=mumps --option local_velocity=current --interface cg
compare 1 box_10k --steps 5
compare 2 box_10k --steps 5 --solver nscdd --subdomains 2x2
compare 1 box_100k --steps 2
compare_solve pyramid 3 --solver newton
compare_solve rotating_box_730 3 --solver nscd
compare_solve clusters 3 "${nscdd[@]}"
compare_solve sloped_flow_750 3 "${fea[@]}"

echo "$cases cases, $differing differ"
(( differing == 0 ))
