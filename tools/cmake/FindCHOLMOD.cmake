# Finds SuiteSparse's CHOLMOD with its supernodal part, and AMD. Defines the target CHOLMOD::CHOLMOD.
#
# A program that asks them for orderings and the symbolic analysis alone can leave out the BLAS,
# which takes as long to load as the rest of a small program: with its property CHOLMOD_ARCHIVES on,
# it takes what it needs out of SuiteSparse's archives, where they are installed and go without a
# BLAS. Debian's are not position-independent code, so that shared libraries cannot do so.
include(FindPackageHandleStandardArgs)
include(CheckCXXSourceCompiles)
include(CMakePushCheckState)

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(AMD_LIBRARY amd)
find_library(SUITESPARSE_CONFIG_LIBRARY suitesparseconfig)

find_package_handle_standard_args(CHOLMOD REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR
                                  AMD_LIBRARY SUITESPARSE_CONFIG_LIBRARY)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY AMD_LIBRARY SUITESPARSE_CONFIG_LIBRARY)

# In the order in which a linker needs them.
set(CHOLMOD_ARCHIVES)
foreach(name cholmod amd suitesparseconfig)
  find_library(CHOLMOD_${name}_ARCHIVE
               ${CMAKE_STATIC_LIBRARY_PREFIX}${name}${CMAKE_STATIC_LIBRARY_SUFFIX})
  mark_as_advanced(CHOLMOD_${name}_ARCHIVE)
  list(APPEND CHOLMOD_ARCHIVES ${CHOLMOD_${name}_ARCHIVE})
endforeach()

if(CHOLMOD_FOUND AND NOT CHOLMOD_ARCHIVES MATCHES NOTFOUND)
  cmake_push_check_state()
  set(CMAKE_REQUIRED_INCLUDES ${CHOLMOD_INCLUDE_DIR})
  set(CMAKE_REQUIRED_LIBRARIES ${CHOLMOD_ARCHIVES})
  check_cxx_source_compiles("
    #include <amd.h>
    #include <cholmod.h>
    int main() {
      return amd_order(0, nullptr, nullptr, nullptr, nullptr, nullptr) +
             cholmod_l_etree(nullptr, nullptr, nullptr) +
             cholmod_l_super_symbolic(nullptr, nullptr, nullptr, nullptr, nullptr);
    }" CHOLMOD_ARCHIVES_NEED_NO_BLAS)
  cmake_pop_check_state()
endif()

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  set(CHOLMOD_LIBRARIES ${CHOLMOD_LIBRARY} ${AMD_LIBRARY} ${SUITESPARSE_CONFIG_LIBRARY})
  if(CHOLMOD_ARCHIVES_NEED_NO_BLAS)
    set(CHOLMOD_LIBRARIES
        "$<IF:$<BOOL:$<TARGET_PROPERTY:CHOLMOD_ARCHIVES>>,${CHOLMOD_ARCHIVES},${CHOLMOD_LIBRARIES}>")
  endif()
  add_library(CHOLMOD::CHOLMOD INTERFACE IMPORTED)
  target_include_directories(CHOLMOD::CHOLMOD SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(CHOLMOD::CHOLMOD INTERFACE "${CHOLMOD_LIBRARIES}")
endif()
