# What `cmake --install` puts in place. Component `program`: the program with man pages and
# completions for shells, its helper, the schema of its reports, a mesh to try it on. Component
# `petsc`: its engine for one mesh on many machines. Component `development`: the library with its
# headers, and the package by which other projects find it: find_package(ibmfair), target
# ibmfair::ibmfair. Component `python` (tools/cmake/python.cmake): the Python package.
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/ibmfair)

install(TARGETS ibmfair RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS ibmfair_assimp RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/ibmfair
        COMPONENT program)
if(IBMFAIR_PETSC)
  install(TARGETS ibmfair_petsc RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/ibmfair
          COMPONENT petsc)
endif()
install(DIRECTORY ${usage_directory}/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR} COMPONENT program)
install(FILES data/femur.off data/README.md data/report.schema.json
        DESTINATION ${CMAKE_INSTALL_DATADIR}/ibmfair COMPONENT program)

install(TARGETS ibmfair_library EXPORT ibmfairTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY src/ibmfair/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ibmfair
        COMPONENT development FILES_MATCHING PATTERN *.h)
install(EXPORT ibmfairTargets NAMESPACE ibmfair:: DESTINATION ${package_directory}
        COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/ibmfairConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/ibmfairConfig.cmake
                              INSTALL_DESTINATION ${package_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ibmfairConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ibmfairConfig.cmake
              ${PROJECT_BINARY_DIR}/ibmfairConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindAMD.cmake
        DESTINATION ${package_directory} COMPONENT development)
