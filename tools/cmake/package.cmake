# What `cpack` makes: Debian packages of the program and of the library's development files, and a
# tarball of both. tools/package does it all.
set(CPACK_PACKAGE_NAME ibmfair)
set(CPACK_PACKAGE_VENDOR "the ibmfair authors")
set(CPACK_PACKAGE_CONTACT "the ibmfair authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fairs triangle meshes by discrete Willmore flow")
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_FILE_NAME ibmfair-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

# The program is what most want; the library's files come in a package of their own.
set(CPACK_COMPONENTS_ALL program development)
if(IBMFAIR_PETSC)  # apart: it needs MPI
  list(APPEND CPACK_COMPONENTS_ALL petsc)
endif()
if(IBMFAIR_PYTHON)  # apart: it needs Python
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL OFF)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME ibmfair)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
if(IBMFAIR_CHOLMOD)  # loaded, and so not found by what looks for linked libraries
  string(REGEX REPLACE "\\.so\\.([0-9]+)$" "\\1" cholmod_package ${CHOLMOD_SONAME})
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS ${cholmod_package})
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libibmfair-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libsuitesparse-dev, libtbb-dev, libfmt-dev, libpng-dev, zlib1g-dev, libmeshoptimizer-dev, libgmp-dev, libmpfr-dev")
set(CPACK_DEBIAN_PETSC_PACKAGE_NAME ibmfair-petsc)
set(CPACK_DEBIAN_PETSC_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PETSC_PACKAGE_DEPENDS "ibmfair (= ${PROJECT_VERSION}), openmpi-bin")
if(IBMFAIR_PYTHON)
  math(EXPR next_python_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-ibmfair)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= ${python_version}~), python3 (<< ${Python_VERSION_MAJOR}.${next_python_minor}), python3-numpy")
  if(IBMFAIR_CHOLMOD)
    string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", ${cholmod_package}")
  endif()
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "ibmfair")  # its helper reads further formats
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-scipy")
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "The functions of ibmfair for Python, on arrays of vertices and faces.")
set(CPACK_COMPONENT_PETSC_DESCRIPTION
    "The engine of ibmfair that shares one mesh among the processes of mpirun, on one
machine or many.")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Removes noise and ripples from scans and CAD meshes without shrinking the shape,
and closes holes with patches that continue the surface. Reads and writes OBJ,
PLY and OFF and changes nothing in a file but the positions.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "The static library under ibmfair, its headers, and what CMake's find_package needs.")

# Where Debian looks for the licence of each package; the tarball has it at the same place.
install(FILES ${PROJECT_SOURCE_DIR}/tools/packaging/copyright
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ibmfair COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/tools/packaging/copyright
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libibmfair-dev COMPONENT development)
if(IBMFAIR_PYTHON)
  install(FILES ${PROJECT_SOURCE_DIR}/tools/packaging/copyright
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-ibmfair COMPONENT python)
endif()
if(IBMFAIR_PETSC)
  install(FILES ${PROJECT_SOURCE_DIR}/tools/packaging/copyright
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ibmfair-petsc COMPONENT petsc)
endif()

include(CPack)
