# SPDX-License-Identifier: Apache-2.0
# cmake --install: headers, libraries, the plugin, the program, the scenes, and what find_package(nscdd) reads.
# The plugin and the program say themselves where they go.
set(NSCDD_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/nscdd)
set(NSCDD_INSTALL_SCENES ${CMAKE_INSTALL_DATADIR}/nscdd/sample_scenes)

set_target_properties(nscdd_api PROPERTIES EXPORT_NAME api)
set_target_properties(nscdd_core PROPERTIES EXPORT_NAME core)
set_target_properties(nscdd_plugin_api PROPERTIES EXPORT_NAME plugin_api)
install(TARGETS nscdd_api nscdd_core nscdd_adapter_reference nscdd_adapter_box2d nscdd_adapter_callback nscdd_conformance
                nscdd_plugin_api nscdd_host
        EXPORT nscddTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT nscddTargets NAMESPACE nscdd:: DESTINATION ${NSCDD_INSTALL_CMAKE})

# The folders whose include/ is public.
set(NSCDD_PUBLIC_PARTS core adapters/reference adapters/box2d adapters/callback adapters/conformance plugin plugin/host)
foreach(part IN LISTS NSCDD_PUBLIC_PARTS)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${part}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/sample_scenes/ DESTINATION ${NSCDD_INSTALL_SCENES})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/nscddConfig.cmake.in ${PROJECT_BINARY_DIR}/nscddConfig.cmake
                              INSTALL_DESTINATION ${NSCDD_INSTALL_CMAKE}
                              PATH_VARS CMAKE_INSTALL_LIBDIR NSCDD_INSTALL_SCENES)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nscddConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nscddConfig.cmake ${PROJECT_BINARY_DIR}/nscddConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/adapters/conformance/NscddConformance.cmake
        DESTINATION ${NSCDD_INSTALL_CMAKE})
