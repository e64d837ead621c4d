# PCL's readers alone: PclIo_FOUND and the target PclIo::PclIo (pcl_io, pcl_common and the headers).
#
# find_package(PCL COMPONENTS io) would want VTK's development files and link all of VTK; pcl_io.pc requires the
# .pc files of every sensor driver PCL was built with (libopenni, libopenni2), which are not always installed. Neither
# is needed to read files, so the library is looked for by itself. Headers lie in a folder that names the version.
set(versions)
foreach(minor RANGE 30 10 -1)
  list(APPEND versions include/pcl-1.${minor})
endforeach()
find_path(PclIo_INCLUDE_DIR pcl/io/pcd_io.h PATH_SUFFIXES ${versions})
find_library(PclIo_LIBRARY pcl_io)
find_library(PclIo_COMMON_LIBRARY pcl_common)
mark_as_advanced(PclIo_INCLUDE_DIR PclIo_LIBRARY PclIo_COMMON_LIBRARY)
if(PclIo_INCLUDE_DIR AND EXISTS ${PclIo_INCLUDE_DIR}/pcl/pcl_config.h)
  file(STRINGS ${PclIo_INCLUDE_DIR}/pcl/pcl_config.h version REGEX "define PCL_VERSION_PRETTY")
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" PclIo_VERSION "${version}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PclIo
  REQUIRED_VARS PclIo_LIBRARY PclIo_COMMON_LIBRARY PclIo_INCLUDE_DIR
  VERSION_VAR PclIo_VERSION)

if(PclIo_FOUND AND NOT TARGET PclIo::PclIo)
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)
  find_package(Boost REQUIRED)
  add_library(PclIo::PclIo INTERFACE IMPORTED)
  target_include_directories(PclIo::PclIo SYSTEM INTERFACE ${PclIo_INCLUDE_DIR})
  target_link_libraries(PclIo::PclIo INTERFACE ${PclIo_LIBRARY} ${PclIo_COMMON_LIBRARY} Eigen3::Eigen Boost::boost)
endif()
