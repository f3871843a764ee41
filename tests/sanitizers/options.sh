# SPDX-License-Identifier: Apache-2.0
# Sourced before tests run under the asan preset. LSan needs whole stacks to recognise frames of libraries built without frame
# pointers, hence the slow unwinder.
sanitizers=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
export ASAN_OPTIONS="detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1:check_initialization_order=1"
ASAN_OPTIONS+=":fast_unwind_on_malloc=0:malloc_context_size=40"
export LSAN_OPTIONS="suppressions='$sanitizers/lsan.supp':print_suppressions=0"
export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1"
unset sanitizers
