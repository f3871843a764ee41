# SPDX-License-Identifier: Apache-2.0
# NSCDD_MPI_LIBRARY: first line of MPI_Get_library_version of the MPI that this build uses. Plugin and host carry it, so that a
# plugin built with another MPI is recognised before a communicator crosses. Give it by hand when cross-compiling.
if(NOT NSCDD_MPI_LIBRARY)
  try_run(NSCDD_MPI_LIBRARY_RUN NSCDD_MPI_LIBRARY_COMPILED
          ${CMAKE_BINARY_DIR}/mpi_library ${CMAKE_CURRENT_LIST_DIR}/mpi_library.c
          LINK_LIBRARIES MPI::MPI_C
          RUN_OUTPUT_VARIABLE NSCDD_MPI_LIBRARY_OUTPUT)
  if(NOT NSCDD_MPI_LIBRARY_COMPILED OR NOT NSCDD_MPI_LIBRARY_RUN EQUAL 0 OR NSCDD_MPI_LIBRARY_OUTPUT STREQUAL "")
    message(FATAL_ERROR "Cannot ask the MPI library for its version (${NSCDD_MPI_LIBRARY_OUTPUT}); "
                        "give it with -DNSCDD_MPI_LIBRARY=...")
  endif()
  set(NSCDD_MPI_LIBRARY "${NSCDD_MPI_LIBRARY_OUTPUT}" CACHE STRING "First line of MPI_Get_library_version")
endif()
