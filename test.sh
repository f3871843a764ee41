#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ./test.sh [PRESET]   installs what is missing, builds the preset and runs all tests.
# PRESET: release (the default), dev, audit, asan, asan-fast (its unit tests alone) or fuzz; see CMakePresets.json.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

usage='Usage: ./test.sh [release|dev|audit|asan|asan-fast|fuzz]'
preset=${1:-release}
case $preset in
  release | dev | audit | asan | asan-fast) ;;
  fuzz) debian_packages+=(clang libclang-rt-14-dev) ;;
  *)
    echo "There is no preset '$preset'. $usage" >&2
    exit 2
    ;;
esac
if (($# > 1)); then
  echo "One preset at a time. $usage" >&2
  exit 2
fi

install_packages
build "$preset"
if [[ $preset == asan* ]]; then source tests/sanitizers/options.sh; fi
exec ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error
