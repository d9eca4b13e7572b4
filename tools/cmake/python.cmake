# The Python package `ibmfair`: the extension module ibmfair._core with the Python files beside it, in
# <build>/python/ibmfair, so that PYTHONPATH=<build>/python finds it without an installation.
# An interpreter without sanitizers cannot load a module with them.
if(IBMFAIR_SANITIZE AND NOT DEFINED IBMFAIR_PYTHON)
  set(IBMFAIR_PYTHON OFF)
endif()
if(NOT DEFINED IBMFAIR_PYTHON OR IBMFAIR_PYTHON)
  # The system's Python, unless another one is in use or asked for: a first `python3` on the PATH
  # may lack numpy.
  if(NOT DEFINED Python_EXECUTABLE AND NOT DEFINED ENV{VIRTUAL_ENV} AND NOT DEFINED ENV{CONDA_PREFIX}
     AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module QUIET)
  set(PYBIND11_FINDPYTHON ON)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
if(Python_Development.Module_FOUND AND pybind11_FOUND)
  set(python_is_there ON)
else()
  set(python_is_there OFF)
endif()
option(IBMFAIR_PYTHON "Build the Python module" ${python_is_there})
if(NOT IBMFAIR_PYTHON)
  return()
endif()
if(NOT python_is_there)
  message(FATAL_ERROR "IBMFAIR_PYTHON needs Python's headers and pybind11 2.10 or later")
endif()

file(GLOB python_sources CONFIGURE_DEPENDS src/python/*.cpp)
set(python_package_directory ${PROJECT_BINARY_DIR}/python/ibmfair)
pybind11_add_module(ibmfair_python MODULE NO_EXTRAS ${python_sources})
set_target_properties(ibmfair_python PROPERTIES OUTPUT_NAME _core
                      LIBRARY_OUTPUT_DIRECTORY ${python_package_directory})
target_include_directories(ibmfair_python PRIVATE src/python)
target_link_libraries(ibmfair_python PRIVATE ibmfair_commands)
# The symbols of the library stay its own, whatever else the interpreter has loaded.
target_link_options(ibmfair_python PRIVATE -Wl,--exclude-libs,ALL)

# The type stubs list the options as the program does.
set(stubs ${python_package_directory}/__init__.pyi)
add_custom_command(
  OUTPUT ${stubs}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${python_package_directory}
  COMMAND ${Python_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/src/python/stubs.py $<TARGET_FILE:ibmfair>
          ${PROJECT_SOURCE_DIR}/src/python/__init__.pyi.in ${stubs}
  DEPENDS ibmfair src/python/stubs.py src/python/__init__.pyi.in src/python/ibmfair/_keywords.py
  COMMENT "Writing the type stubs of the Python package")

file(GLOB python_files CONFIGURE_DEPENDS src/python/ibmfair/*)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/python/copied
  COMMAND ${CMAKE_COMMAND} -E make_directory ${python_package_directory}
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${python_files} ${python_package_directory}
  # The helper that reads foreign formats is found beside the module.
  COMMAND ${CMAKE_COMMAND} -E create_symlink $<TARGET_FILE:ibmfair_assimp>
          ${python_package_directory}/$<TARGET_FILE_NAME:ibmfair_assimp>
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/python/copied
  DEPENDS ${python_files} COMMENT "Copying the files of the Python package")
add_custom_target(ibmfair_python_files ALL DEPENDS ${PROJECT_BINARY_DIR}/python/copied ${stubs})

# Where this Python looks below the prefix. Debian has one folder for packages, and others for what
# the administrator installs.
execute_process(
  COMMAND ${Python_EXECUTABLE} -c "import sysconfig; print('deb_system' in sysconfig.get_scheme_names())"
  OUTPUT_VARIABLE python_is_debians OUTPUT_STRIP_TRAILING_WHITESPACE)
set(python_version ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})
if(python_is_debians STREQUAL "True")
  set(python_site python${python_version}/dist-packages)
  set(python_site_of_packages python3/dist-packages)
else()
  set(python_site python${python_version}/site-packages)
  set(python_site_of_packages ${python_site})
endif()
install(CODE "
  if(CMAKE_INSTALL_PREFIX MATCHES \"/usr$\")
    set(site ${python_site_of_packages})
  else()
    set(site ${python_site})
  endif()
  file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/lib/\${site}\" TYPE DIRECTORY
       FILES \"${python_package_directory}\" PATTERN __pycache__ EXCLUDE PATTERN ibmfair-* EXCLUDE)"
  COMPONENT python)
