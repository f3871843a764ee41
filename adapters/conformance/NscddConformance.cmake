# SPDX-License-Identifier: Apache-2.0
# nscdd_add_conformance_tests(TARGET <executable> [PREFIX <name>] [EXCEPT <check>...] [BROKEN] [SEED <number>])
#
# Registers every conformance check as a test of its own, named <PREFIX>.<check> (PREFIX: conformance.<executable> if not
# given). The executable's main() calls nscdd::conformance::Main. EXCEPT leaves checks out. A check is skipped where the adapter
# does not declare the capability. BROKEN runs the check on adapters that are broken on purpose, and passes if it catches
# them all.
set_property(GLOBAL PROPERTY NSCDD_CONFORMANCE_CHECKS
    description ids_stable bodies_round_trip clusters_round_trip loads prescribed_motion
    pairs_complete pairs_complete_after_drift pairs_sorted order_free_of_history filters_honoured
    gap_in_double frame_from_a_to_b coincident_centres wall_skin_zero levers_and_arms
    sweep_pairs sweep_meetings sweep_walls
    detects_at_given_poses commit_visible host_edits_adopted two_instances refusals_speak
    distributed_detection periodic_images both_images
    head_on_pair sliding_disk rolling_disk)

function(nscdd_add_conformance_tests)
  get_property(all_checks GLOBAL PROPERTY NSCDD_CONFORMANCE_CHECKS)
  cmake_parse_arguments(PARSE_ARGV 0 arg "BROKEN" "TARGET;PREFIX;SEED" "EXCEPT")
  if(NOT TARGET "${arg_TARGET}")
    message(FATAL_ERROR "nscdd_add_conformance_tests: TARGET \"${arg_TARGET}\" is no executable of this project.")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "nscdd_add_conformance_tests: unknown arguments ${arg_UNPARSED_ARGUMENTS}.")
  endif()
  if(NOT arg_PREFIX)
    set(arg_PREFIX "conformance.${arg_TARGET}")
  endif()
  set(options "")
  if(arg_BROKEN)
    list(APPEND options --broken)
  endif()
  if(arg_SEED)
    list(APPEND options --seed ${arg_SEED})
  endif()
  foreach(check IN LISTS arg_EXCEPT)
    if(NOT check IN_LIST all_checks)
      message(FATAL_ERROR "nscdd_add_conformance_tests: EXCEPT names \"${check}\", which is no check: ${all_checks}.")
    endif()
  endforeach()
  foreach(check IN LISTS all_checks)
    if(NOT check IN_LIST arg_EXCEPT)
      add_test(NAME ${arg_PREFIX}.${check} COMMAND ${arg_TARGET} --check ${check} ${options})
      set_tests_properties(${arg_PREFIX}.${check} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 120)
    endif()
  endforeach()
endfunction()
