# SPDX-License-Identifier: Apache-2.0
# Headers compile by themselves. A header that is the first include of a source does so with that source; for every other one,
# and for the C interface in C, target headers_self_contained compiles a source that includes nothing else.
file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/*.h ${PROJECT_SOURCE_DIR}/adapters/*.h
                                            ${PROJECT_SOURCE_DIR}/plugin/*.h)
file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/*.cpp ${PROJECT_SOURCE_DIR}/adapters/*.cpp
                                            ${PROJECT_SOURCE_DIR}/plugin/*.cpp)

# What the first #include of each source names: a file beside it, or the end of a header's path.
set(first_includes "")
foreach(source IN LISTS sources)
  file(STRINGS ${source} line REGEX "^#include" LIMIT_COUNT 1)
  if(NOT line MATCHES "\"(.*)\"")
    continue()
  endif()
  cmake_path(GET source PARENT_PATH folder)
  if(EXISTS ${folder}/${CMAKE_MATCH_1})
    list(APPEND first_includes ${folder}/${CMAKE_MATCH_1})
  else()
    string(REGEX REPLACE "([][+.*()^])" "\\\\\\1" name ${CMAKE_MATCH_1})
    set(found ${headers})
    list(FILTER found INCLUDE REGEX "/${name}$")
    list(APPEND first_includes ${found})
  endif()
endforeach()
list(REMOVE_ITEM headers ${first_includes})

set(alone "")
foreach(header IN LISTS headers)
  cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
  string(REPLACE "/" "." name ${name})
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp CONTENT "#include \"${header}\"\n")
  list(APPEND alone ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/headers/nscdd_plugin.h.c CONTENT "#include \"nscdd_plugin.h\"\n")

add_library(headers_self_contained OBJECT ${alone} ${CMAKE_CURRENT_BINARY_DIR}/headers/nscdd_plugin.h.c)
target_include_directories(headers_self_contained PRIVATE ${PROJECT_SOURCE_DIR}/core/src ${PROJECT_SOURCE_DIR}/plugin/host)
target_link_libraries(headers_self_contained PRIVATE
  nscdd::core nscdd::reference nscdd::box2d nscdd::callback nscdd::conformance nscdd_options nscdd::host nscdd::scene
  nscdd::results nscdd::checkpoint nscdd::render nscdd::problem nscdd::tradeoff nscdd::auto nscdd::extremes
  Eigen3::Eigen MPI::MPI_CXX fmt::fmt nscdd_build_flags)
target_compile_options(headers_self_contained PRIVATE -O0)  # nothing of it is run
