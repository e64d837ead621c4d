# The packages for Debian, one per component: `cpack` in the build of the preset `packages`, which has shared libraries.
# tools/check_packages.sh makes and tries them.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_CONTACT "the Tufted authors")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# Where dpkg-shlibdeps finds the libraries of the project, which no package has yet.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src ${PROJECT_BINARY_DIR}/src/io
    ${PROJECT_BINARY_DIR}/src/view)
set(CPACK_COMPONENTS_ALL)

# tufted_package(COMPONENT NAME SECTION SUMMARY DEPENDS...): of libraries, dpkg-shlibdeps finds out what they need.
function(tufted_package component name section summary)
  string(TOUPPER ${component} upper)
  string(JOIN ", " depends ${ARGN})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "This package has ${summary}." PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  install(FILES ${PROJECT_SOURCE_DIR}/tools/packages/copyright DESTINATION share/doc/${name} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
endfunction()

set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(same "(= ${PROJECT_VERSION})")
tufted_package(library libtufted${abi} libs "the libraries for computing, files, and pictures")
tufted_package(development libtufted-dev libdevel "the headers and CMake files" "libtufted${abi} ${same}" libeigen3-dev)
if(TUFTED_BUILD_TOOLS)
  tufted_package(command tufted science "the command" "libtufted${abi} ${same}")
endif()
if(TUFTED_WITH_PYTHON)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  tufted_package(python python3-tufted python "the package for Python" "libtufted${abi} ${same}"
                 "python3 (>= 3.${Python_VERSION_MINOR})" "python3 (<< 3.${next})" python3-numpy python3-scipy)
endif()
if(TUFTED_WITH_PCL)
  tufted_package(pcl_library libtufted-pcl${abi} libs "the classes for PCL" "libtufted${abi} ${same}")
  tufted_package(pcl_development libtufted-pcl-dev libdevel "the headers and CMake files of the classes for PCL"
                 "libtufted-pcl${abi} ${same}" "libtufted-dev ${same}" libpcl-dev)
endif()
include(CPack)
