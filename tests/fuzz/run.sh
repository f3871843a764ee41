#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes one target: run.sh PROGRAM NAME SECONDS [libFuzzer options]. New inputs go to a folder beside the program, crashes too.
set -eu
program=$1 name=$2 seconds=$3
shift 3
here=$(dirname "$(readlink -f "$0")")
work=$(dirname "$program")/fuzz_$name.inputs
mkdir -p "$work"
options=(-max_total_time="$seconds" -timeout=2 -rss_limit_mb=1024 -malloc_limit_mb=512 -max_len=4096 -print_final_stats=1
         -artifact_prefix="$work/" -verbosity=0 -print_funcs=0 -entropic=0 -detect_leaks=0)
[[ -f $here/$name.dict ]] && options+=(-dict="$here/$name.dict")
# Short stacks of allocations and a small quarantine make it some times faster; run a fault without them for the whole story.
export ASAN_OPTIONS=malloc_context_size=1:quarantine_size_mb=16 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export OPENBLAS_NUM_THREADS=1  # its idle threads spin at each start
mkdir -p "$work/new"
exec "$program" "${options[@]}" "$@" "$work/new" "$here"/*/"$name"
