#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The long run, from the project's root: tests/fuzz/long.sh [EXECUTIONS per target, default 10000000] [TARGET ...]. Builds
# preset fuzz, then fuzzes one target after the other, niced; ends with the first fault, whose input it names. Several may run
# side by side, each with targets of its own.
set -eu
cd "$(dirname "$(readlink -f "$0")")/../.."
executions=${1:-10000000}
shift || true
targets=("$@")
((${#targets[@]})) || targets=(packing options scene problem checkpoint host)
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
for target in "${targets[@]}"; do
  echo "== $target"
  nice tests/fuzz/run.sh "build/fuzz/bin/fuzz_$target" "$target" 0 -runs="$executions" 2>&1 | tee "build/fuzz/$target.log" |
    grep -E "stat::|SUMMARY|ERROR|artifact" || true
  test "${PIPESTATUS[0]}" -eq 0
done
