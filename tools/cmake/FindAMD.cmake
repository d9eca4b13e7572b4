# Finds SuiteSparse's AMD. Defines the target AMD::AMD.
include(FindPackageHandleStandardArgs)

find_path(AMD_INCLUDE_DIR amd.h PATH_SUFFIXES suitesparse)
find_library(AMD_LIBRARY amd)
find_library(SUITESPARSE_CONFIG_LIBRARY suitesparseconfig)
find_package_handle_standard_args(AMD REQUIRED_VARS AMD_LIBRARY AMD_INCLUDE_DIR
                                  SUITESPARSE_CONFIG_LIBRARY)
mark_as_advanced(AMD_INCLUDE_DIR AMD_LIBRARY SUITESPARSE_CONFIG_LIBRARY)

if(AMD_FOUND AND NOT TARGET AMD::AMD)
  add_library(AMD::AMD INTERFACE IMPORTED)
  target_include_directories(AMD::AMD SYSTEM INTERFACE ${AMD_INCLUDE_DIR})
  target_link_libraries(AMD::AMD INTERFACE ${AMD_LIBRARY} ${SUITESPARSE_CONFIG_LIBRARY})
endif()
