#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# All test programs of one process under valgrind: no invalid access, no use of unset memory, nothing lost for good.
#     tests/sanitizers/valgrind.sh [PROGRAM ...]     (default: all of build/release/bin; about five minutes on one core)
# Needs Debian's valgrind. Exit code 1 if a test fails or valgrind objects.
set -uo pipefail
cd "$(dirname "$0")/../.."
bin=build/release/bin
programs=("$@")
if ((${#programs[@]} == 0)); then programs=("$bin"/unit_* "$bin"/conformance_* "$bin"/nscdd_plugin_tests); fi
command -v valgrind >/dev/null || { echo "valgrind is missing: apt-get install valgrind" >&2; exit 2; }
[[ -x ${programs[0]} ]] || { echo "${programs[0]} is missing: run ./test.sh first" >&2; exit 2; }

failed=0
for program in "${programs[@]}"; do
  log=$(mktemp)
  start=$SECONDS
  valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
    --num-callers=30 --suppressions=/usr/share/openmpi/openmpi-valgrind.supp --suppressions=tests/sanitizers/valgrind.supp \
    "$program" >"$log" 2>&1
  code=$?
  printf '%-40s exit code %d, %d s\n' "${program##*/}" "$code" $((SECONDS - start))
  if ((code != 0)); then
    failed=1
    grep -E '^==|FAILED' "$log" | head -60
  fi
  rm -f "$log"
done
exit "$failed"
