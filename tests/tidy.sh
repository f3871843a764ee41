#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tests/tidy.sh [BASE]   runs clang-tidy (Debian's package of this name; checks: .clang-tidy) on the sources that differ from
#                        the commit BASE, by default from origin/main, or HEAD~1 where there is no such branch
# tests/tidy.sh --full   on all of them
# PRESET=dev tests/tidy.sh   by the compile commands of another preset than release. A changed header is seen through its own
# source, or the first one that includes it. Exit code 1 if there is a finding.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${PRESET:-release}
if ! command -v clang-tidy >/dev/null; then
  echo "There is no clang-tidy: apt-get install clang-tidy" >&2
  exit 2
fi
[[ -f build/$preset/compile_commands.json ]] || cmake --preset "$preset" >/dev/null

changed_files() {
  local base=${1:-origin/main}
  if [[ $# == 0 ]] && ! git rev-parse --quiet --verify "$base" >/dev/null; then base=HEAD~1; fi
  git diff --name-only --diff-filter=d "$(git merge-base "$base" HEAD)"
  git ls-files --others --exclude-standard
}

# The sources, one a line, through which the files on stdin are checked.
sources_of() {
  local file name
  while read -r file; do
    case $file in
      *.cpp) echo "$file" ;;
      *.h)
        name=${file%.h}
        if [[ -f $name.cpp ]]; then echo "$name.cpp"; else git grep -l "#include \".*${file##*/}\"" -- '*.cpp' | head -n 1; fi
        ;;
    esac
  done | sort -u
}

if [[ ${1:-} == --full ]]; then sources=$(git ls-files '*.cpp'); else sources=$(changed_files "$@" | sources_of); fi
# Only what this preset compiles: fuzz targets and the like have no command there.
known=$(grep -o '"file": "[^"]*"' "build/$preset/compile_commands.json" | cut -d'"' -f4)
sources=$(grep -Fxf <(sed "s|^$PWD/||" <<<"$known") <<<"$sources" || true)
if [[ -z $sources ]]; then
  echo "No source to check."
  exit 0
fi
echo "$(wc -l <<<"$sources") sources"
tr '\n' '\0' <<<"$sources" | xargs -0 -n 1 -P "$(nproc)" nice clang-tidy -p "build/$preset" --quiet \
  --warnings-as-errors='*' 2> >(grep -vE '^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header-filter' >&2)
