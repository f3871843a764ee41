# SPDX-License-Identifier: Apache-2.0
# cmake --install: the scenes, and what find_package(nscdd) reads. Every part says itself where its headers and libraries go
# (nscdd_install_part of parts.cmake, or an install rule of its own).
set(NSCDD_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/nscdd)
set(NSCDD_INSTALL_SCENES ${CMAKE_INSTALL_DATADIR}/nscdd/sample_scenes)

install(EXPORT nscddTargets NAMESPACE nscdd:: DESTINATION ${NSCDD_INSTALL_CMAKE})

install(DIRECTORY ${PROJECT_SOURCE_DIR}/sample_scenes/ DESTINATION ${NSCDD_INSTALL_SCENES})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/nscddConfig.cmake.in ${PROJECT_BINARY_DIR}/nscddConfig.cmake
                              INSTALL_DESTINATION ${NSCDD_INSTALL_CMAKE}
                              PATH_VARS CMAKE_INSTALL_LIBDIR NSCDD_INSTALL_SCENES)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nscddConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nscddConfig.cmake ${PROJECT_BINARY_DIR}/nscddConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/adapters/conformance/NscddConformance.cmake
        DESTINATION ${NSCDD_INSTALL_CMAKE})
