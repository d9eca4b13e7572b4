# Finds SuiteSparse's CHOLMOD. Defines the target CHOLMOD::CHOLMOD, for programs that link it, and
# CHOLMOD_INCLUDE_DIR and CHOLMOD_SONAME, for programs that load it when they need it: the name by
# which the system's loader finds the library of these headers.
include(FindPackageHandleStandardArgs)

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_package_handle_standard_args(CHOLMOD REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)

if(CHOLMOD_FOUND)
  set(CHOLMOD_SONAME ${CHOLMOD_LIBRARY})
  execute_process(COMMAND ${CMAKE_READELF} -d ${CHOLMOD_LIBRARY}
                  OUTPUT_VARIABLE dynamic_section ERROR_QUIET)
  if(dynamic_section MATCHES "SONAME[^[]*\\[([^]]+)\\]")
    set(CHOLMOD_SONAME ${CMAKE_MATCH_1})
  endif()
endif()

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD INTERFACE IMPORTED)
  target_include_directories(CHOLMOD::CHOLMOD SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(CHOLMOD::CHOLMOD INTERFACE ${CHOLMOD_LIBRARY})
endif()
