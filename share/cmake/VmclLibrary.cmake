# SPDX-License-Identifier: BSD-3-Clause
#
# vmcl_add_library(NAME SOURCES ... [PUBLIC ...] [PRIVATE ...])
# One library of libs/NAME: target vmcl::NAME, file libvmcl-NAME.so, headers vmcl/NAME/*.h, installed and exported.
function(vmcl_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target vmcl_${name})
  add_library(${target} ${ARG_SOURCES})
  add_library(vmcl::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME vmcl-${name} EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  install(TARGETS ${target} EXPORT vmclTargets)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
