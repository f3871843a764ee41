#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Settles the packings of ../packings again and compares them bit for bit.
#     regenerate.sh NSCDD            compares
#     regenerate.sh NSCDD --write    replaces them
set -eu
nscdd=${1:?give the nscdd program, such as build/release/bin/nscdd}
here=$(cd "$(dirname "$0")" && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
status=0
for name in rotating_box_730 rotating_box_730_frictionless sloped_flow_750; do
  "$nscdd" run "$here/$name.toml" --out "$out/$name" --quiet
  cut -d, -f1-5 "$out/$name/$name.csv" >"$out/$name.csv"  # at rest, of the only material
  if [ "${2:-}" = --write ]; then
    cp "$out/$name.csv" "$here/../packings/$name.csv"
  elif cmp "$out/$name.csv" "$here/../packings/$name.csv"; then
    echo "$name: the same"
  else
    status=1
  fi
done
exit $status
