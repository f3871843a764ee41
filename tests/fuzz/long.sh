#!/bin/bash
# The long run, from the project's root: tests/fuzz/long.sh [SECONDS per target, default 3600] [TARGET ...]. Builds preset fuzz, then
# fuzzes one target after the other, niced; ends with the first fault, whose input it names.
set -eu
cd "$(dirname "$(readlink -f "$0")")/../.."
seconds=${1:-3600}
shift || true
targets=("$@")
((${#targets[@]})) || targets=(packing options scene problem checkpoint host)
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
for target in "${targets[@]}"; do
  echo "== $target"
  nice tests/fuzz/run.sh "build/fuzz/bin/fuzz_$target" "$target" "$seconds" 2>&1 | tee "build/fuzz/$target.log" |
    grep -E "stat::|SUMMARY|ERROR|artifact" || true
  test "${PIPESTATUS[0]}" -eq 0
done
