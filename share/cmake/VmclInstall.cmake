# SPDX-License-Identifier: BSD-3-Clause
# What another project needs for find_package(vmcl), and the data that the command comes with.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vmcl)
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/vmclConfig.cmake.in ${PROJECT_BINARY_DIR}/vmclConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vmclConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vmclConfig.cmake ${PROJECT_BINARY_DIR}/vmclConfigVersion.cmake
  DESTINATION ${package_dir})
install(EXPORT vmclTargets NAMESPACE vmcl:: DESTINATION ${package_dir})
foreach(data cluster config experiments scenes)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/${data}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/vmcl USE_SOURCE_PERMISSIONS)
endforeach()
