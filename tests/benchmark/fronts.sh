#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The trade on five scenes: a CSV file and a picture each, and the tables of FRONTS.md. At most about five minutes a scene.
#     tests/benchmark/fronts.sh [FOLDER (sample_scenes/tradeoff)] [PROGRAM (build/release/bin/nscdd)] [SCENE... (all)]
# Pin it to one core for steadier seconds: taskset -c 0 tests/benchmark/fronts.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=${1:-sample_scenes/tradeoff}
nscdd=${2:-build/release/bin/nscdd}
scenes=${*:3}  # all of them if empty
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

measure() {  # scene, time limit [s], options
  local scene=$1 limit=$2
  shift 2
  if [ -n "$scenes" ] && [[ " $scenes " != *" $scene "* ]]; then return; fi
  "$nscdd" tradeoff "sample_scenes/$scene.toml" --time-limit "$limit" --out "$work/$scene" "$@"
  cp "$work/$scene/tradeoff.csv" "$folder/$scene.csv"
  if [ -f "$work/$scene/tradeoff.png" ]; then cp "$work/$scene/tradeoff.png" "$folder/$scene.png"; fi
}

measure rotating_box_730 300 --steps 50 --problems 10 --repetitions 3
measure rotating_box_730_frictionless 300 --steps 50 --problems 10 --repetitions 3
measure sloped_flow_750 300 --steps 50 --problems 10 --repetitions 3 --observable flow_rate
measure drum 300 --steps 150 --problems 10 --repetitions 3
# Without fea and newton: a single solve of theirs may last longer than all the rest.
measure box_10k 330 --steps 6 --problems 3 --repetitions 1 --solvers nscd,nscdd,iea,box2d
python3 tests/benchmark/fronts.py "$folder" > "$folder/FRONTS.md"
echo "$folder/FRONTS.md"
