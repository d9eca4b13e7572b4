# The cloth simulation of tools/drape; not part of the ordinary build, but for its tests.
file(GLOB cloth_sources CONFIGURE_DEPENDS tools/cloth/*.cpp)
list(FILTER cloth_sources EXCLUDE REGEX /main.cpp$)
add_library(ibmfair_cloth STATIC EXCLUDE_FROM_ALL ${cloth_sources})
target_include_directories(ibmfair_cloth PUBLIC ${PROJECT_SOURCE_DIR}/tools)
target_include_directories(ibmfair_cloth SYSTEM PRIVATE ${CGAL_INCLUDE_DIR})
target_link_libraries(ibmfair_cloth PUBLIC ibmfair_library fmt::fmt ibmfair_flags
                                    PRIVATE ${MPFR_LIBRARY} ${GMP_LIBRARY})
# Includes CGAL: its predicates change the rounding mode.
set_source_files_properties(tools/cloth/sheet_meshes.cpp PROPERTIES
                            COMPILE_OPTIONS -frounding-math SKIP_UNITY_BUILD_INCLUSION ON)

add_executable(drape EXCLUDE_FROM_ALL tools/cloth/main.cpp)
target_link_libraries(drape PRIVATE ibmfair_cloth ibmfair_commands)
