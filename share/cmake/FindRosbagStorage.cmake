# SPDX-License-Identifier: BSD-3-Clause
#
# Target RosbagStorage: reads and writes ROS 1 bags. Debian's librosbag-storage-dev comes without a configuration for
# CMake that works, and its headers include those of ROS 2 packages, which stand in directories of their own.
include(FindPackageHandleStandardArgs)
set(libraries rosbag_storage roscpp_serialization rostime console_bridge)
set(headers rosbag/bag.h pluginlib/class_loader.hpp class_loader/multi_library_class_loader.hpp
  rcpputils/shared_library.hpp rcutils/shared_library.h ament_index_cpp/get_package_prefix.hpp)
set(found)
set(directories)
foreach(library ${libraries})
  find_library(${library}_LIBRARY ${library})
  list(APPEND found ${library}_LIBRARY)
endforeach()
foreach(header ${headers})
  string(REGEX REPLACE "/.*" "" package ${header})
  find_path(${package}_INCLUDE_DIRECTORY ${header} PATH_SUFFIXES ${package})
  list(APPEND found ${package}_INCLUDE_DIRECTORY)
  list(APPEND directories ${${package}_INCLUDE_DIRECTORY})
endforeach()
find_package_handle_standard_args(RosbagStorage REQUIRED_VARS ${found})
if(RosbagStorage_FOUND AND NOT TARGET RosbagStorage)
  list(REMOVE_DUPLICATES directories)
  list(REMOVE_ITEM directories /usr/include)
  add_library(RosbagStorage INTERFACE IMPORTED)
  set_target_properties(RosbagStorage PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${directories}")
  target_link_libraries(RosbagStorage INTERFACE
    ${rosbag_storage_LIBRARY} ${roscpp_serialization_LIBRARY} ${rostime_LIBRARY} ${console_bridge_LIBRARY})
endif()
