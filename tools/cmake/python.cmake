# The Python package `ibmfair`: the extension module ibmfair._core with the Python files beside it, in
# <build>/python/ibmfair, so that PYTHONPATH=<build>/python finds it without an installation.
if(NOT DEFINED IBMFAIR_PYTHON OR IBMFAIR_PYTHON)
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

file(GLOB python_files CONFIGURE_DEPENDS src/python/ibmfair/*)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/python/copied
  COMMAND ${CMAKE_COMMAND} -E make_directory ${python_package_directory}
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${python_files} ${python_package_directory}
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/python/copied
  DEPENDS ${python_files} COMMENT "Copying the Python files")
add_custom_target(ibmfair_python_files ALL DEPENDS ${PROJECT_BINARY_DIR}/python/copied)
