# Single libraries of PCL: `find_package(PclParts COMPONENTS io search)` gives PclParts::io and PclParts::search, each
# with PclParts::common, which has the headers.
#
# find_package(PCL COMPONENTS io) would want VTK's development files and link all of VTK; pcl_io.pc requires the
# .pc files of every sensor driver PCL was built with (libopenni, libopenni2), which are not always installed; and asked
# for from our package, PCL's configuration would overwrite the PCL_LIBRARIES of a project that found PCL before. So the
# libraries are looked for one by one. Headers lie in a folder that names the version.
set(versions)
foreach(minor RANGE 30 10 -1)
  list(APPEND versions include/pcl-1.${minor})
endforeach()
find_path(PclParts_INCLUDE_DIR pcl/pcl_config.h PATH_SUFFIXES ${versions})
find_library(PclParts_common_LIBRARY pcl_common)
mark_as_advanced(PclParts_INCLUDE_DIR PclParts_common_LIBRARY)
foreach(part IN LISTS PclParts_FIND_COMPONENTS)
  find_library(PclParts_${part}_LIBRARY pcl_${part})
  mark_as_advanced(PclParts_${part}_LIBRARY)
  if(PclParts_${part}_LIBRARY)
    set(PclParts_${part}_FOUND TRUE)
  endif()
endforeach()
if(PclParts_INCLUDE_DIR)
  file(STRINGS ${PclParts_INCLUDE_DIR}/pcl/pcl_config.h version REGEX "define PCL_VERSION_PRETTY")
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" PclParts_VERSION "${version}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PclParts
  REQUIRED_VARS PclParts_common_LIBRARY PclParts_INCLUDE_DIR
  VERSION_VAR PclParts_VERSION
  HANDLE_COMPONENTS)

if(PclParts_FOUND AND NOT TARGET PclParts::common)
  find_package(Eigen3 3.3 REQUIRED NO_MODULE)
  find_package(Boost REQUIRED)
  add_library(PclParts::common INTERFACE IMPORTED)
  target_include_directories(PclParts::common SYSTEM INTERFACE ${PclParts_INCLUDE_DIR})
  target_link_libraries(PclParts::common INTERFACE ${PclParts_common_LIBRARY} Eigen3::Eigen Boost::boost)
endif()
foreach(part IN LISTS PclParts_FIND_COMPONENTS)
  if(PclParts_FOUND AND NOT TARGET PclParts::${part})
    add_library(PclParts::${part} INTERFACE IMPORTED)
    target_link_libraries(PclParts::${part} INTERFACE ${PclParts_${part}_LIBRARY} PclParts::common)
  endif()
endforeach()
