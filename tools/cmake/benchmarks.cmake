# The programs of tools/bench, in the folder benchmarks/ of the build; not part of the ordinary
# build. One whose packages are not installed is left out; tools/bench installs them where it can.
find_package(benchmark QUIET)
find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/IO/MeshIO.hh)
find_library(OPENMESH_CORE_LIBRARY OpenMeshCore)
find_library(OPENMESH_TOOLS_LIBRARY OpenMeshTools)
find_library(OPENBLAS_LIBRARY openblas PATH_SUFFIXES openblas-pthread)
mark_as_advanced(OPENMESH_INCLUDE_DIR OPENMESH_CORE_LIBRARY OPENMESH_TOOLS_LIBRARY OPENBLAS_LIBRARY)

add_custom_target(benchmarks)

# add_benchmark(NAME SOURCE...): tools/benchmarks/SOURCE...
function(add_benchmark name)
  list(TRANSFORM ARGN PREPEND tools/benchmarks/ OUTPUT_VARIABLE sources)
  add_executable(${name} EXCLUDE_FROM_ALL ${sources})
  set_target_properties(${name} PROPERTIES
                        RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/benchmarks)
  add_dependencies(benchmarks ${name})
endfunction()

if(IBMFAIR_CHOLMOD)
  add_benchmark(factorizations factorizations.cpp)
  target_link_libraries(factorizations PRIVATE ibmfair_library CHOLMOD::CHOLMOD ibmfair_flags)
endif()

if(CHOLMOD_FOUND)
  add_benchmark(bilaplacian_smooth bilaplacian_smooth.cpp)
  target_link_libraries(bilaplacian_smooth PRIVATE ibmfair_library CHOLMOD::CHOLMOD ibmfair_flags)

  add_benchmark(cgal_smooth cgal_smooth.cpp)
  target_include_directories(cgal_smooth SYSTEM PRIVATE ${CGAL_INCLUDE_DIR})
  target_compile_definitions(cgal_smooth PRIVATE CGAL_EIGEN3_ENABLED)
  target_compile_options(cgal_smooth PRIVATE -frounding-math)
  target_link_libraries(cgal_smooth PRIVATE Eigen3::Eigen CHOLMOD::CHOLMOD ${MPFR_LIBRARY}
                        ${GMP_LIBRARY})
endif()

if(OPENMESH_INCLUDE_DIR AND OPENMESH_CORE_LIBRARY AND OPENMESH_TOOLS_LIBRARY)
  add_benchmark(openmesh_smooth openmesh_smooth.cpp)
  target_include_directories(openmesh_smooth SYSTEM PRIVATE ${OPENMESH_INCLUDE_DIR})
  target_link_libraries(openmesh_smooth PRIVATE ${OPENMESH_CORE_LIBRARY}
                        ${OPENMESH_TOOLS_LIBRARY})
endif()

if(benchmark_FOUND AND OPENBLAS_LIBRARY)
  add_benchmark(kernels kernels.cpp machine_limits.cpp stages.cpp)
  target_link_libraries(kernels PRIVATE ibmfair_library benchmark::benchmark ${OPENBLAS_LIBRARY}
                        ibmfair_flags)
endif()
