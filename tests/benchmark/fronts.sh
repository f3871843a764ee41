#!/usr/bin/env bash
# The trade on five scenes: a CSV file and a picture each, and the tables of FRONTS.md. At most about five minutes a scene.
#     tests/benchmark/fronts.sh [FOLDER (default: sample_scenes/tradeoff)] [PROGRAM (default: build/release/bin/nscdd)]
# Pin it to one core for steadier seconds: taskset -c 0 tests/benchmark/fronts.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=${1:-sample_scenes/tradeoff}
nscdd=${2:-build/release/bin/nscdd}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

measure() {  # scene, options
  local scene=$1
  shift
  "$nscdd" tradeoff "sample_scenes/$scene.toml" --time-limit 300 --out "$work/$scene" "$@"
  cp "$work/$scene/tradeoff.csv" "$folder/$scene.csv"
  if [ -f "$work/$scene/tradeoff.png" ]; then cp "$work/$scene/tradeoff.png" "$folder/$scene.png"; fi
}

measure rotating_box_730 --steps 50 --problems 10 --repetitions 3
measure rotating_box_730_frictionless --steps 50 --problems 10 --repetitions 3
measure sloped_flow_750 --steps 50 --problems 10 --repetitions 3 --observable flow_rate
measure drum --steps 150 --problems 10 --repetitions 3
measure box_10k --steps 8 --problems 4 --repetitions 1
python3 tests/benchmark/fronts.py "$folder" > "$folder/FRONTS.md"
echo "$folder/FRONTS.md"
