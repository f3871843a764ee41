# SPDX-License-Identifier: Apache-2.0
# A part that others may link: its headers in include/, its targets nscdd_... as nscdd::NAME.
#     nscdd_install_part(TARGET NAME [TARGET NAME ...])
# The global property NSCDD_PUBLIC_PARTS lists the folders whose include/ is public.
function(nscdd_install_part)
  while(ARGN)
    list(POP_FRONT ARGN target name)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    install(TARGETS ${target} EXPORT nscddTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endwhile()
  set_property(GLOBAL APPEND PROPERTY NSCDD_PUBLIC_PARTS ${CMAKE_CURRENT_SOURCE_DIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# Makes a text file part of a target, as `extern const char SYMBOL[]` of namespace nscdd.
function(nscdd_embed_text target file symbol)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  file(READ ${file} text)
  file(CONFIGURE OUTPUT ${symbol}.cpp @ONLY
       CONTENT "namespace nscdd {\nextern const char @symbol@[];\nconst char @symbol@[] = R\"__(@text@)__\";\n}\n")
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
endfunction()
