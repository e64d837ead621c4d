# CHOLMOD of SuiteSparse and the BLAS that it calls: Cholmod::Cholmod. SuiteSparse before 7 has no CMake configuration of its own.
find_path(Cholmod_INCLUDE_DIR suitesparse/cholmod.h)
find_library(Cholmod_LIBRARY cholmod)
find_library(Cholmod_BLAS_LIBRARY NAMES blas openblas)
mark_as_advanced(Cholmod_INCLUDE_DIR Cholmod_LIBRARY Cholmod_BLAS_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Cholmod REQUIRED_VARS Cholmod_LIBRARY Cholmod_BLAS_LIBRARY Cholmod_INCLUDE_DIR)

if(Cholmod_FOUND AND NOT TARGET Cholmod::Cholmod)
  add_library(Cholmod::Cholmod UNKNOWN IMPORTED)
  set_target_properties(Cholmod::Cholmod PROPERTIES
    IMPORTED_LOCATION ${Cholmod_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${Cholmod_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES ${Cholmod_BLAS_LIBRARY})
endif()
