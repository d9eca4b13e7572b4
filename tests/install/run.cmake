# Installs the project from BUILD below WORK, builds a project that knows nothing but the installed
# files, and runs it and the installed program.
#   cmake -D BUILD=... -D WORK=... -D CXX=... -D CXX_FLAGS=... [-D PYTHON=...] -P run.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)

# build_project SOURCE BUILD: with nothing but what is installed.
function(build_project source build)
  run(${CMAKE_COMMAND} -S ${source} -B ${build}
      -D CMAKE_PREFIX_PATH=${WORK}/installed -D CMAKE_BUILD_TYPE=Release
      -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_CXX_FLAGS=${CXX_FLAGS}
      -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
  run(${CMAKE_COMMAND} --build ${build})
endfunction()

build_project(${CMAKE_CURRENT_LIST_DIR} ${WORK}/build)
run(${WORK}/build/uses_ibmfair)
if(NOT output MATCHES "energy 25\\.1")
  message(FATAL_ERROR "8 pi expected, not\n${output}")
endif()

run(${WORK}/installed/bin/ibmfair --version)
foreach(file man/man1/ibmfair.1 man/man1/ibmfair-smooth.1 bash-completion/completions/ibmfair
             zsh/site-functions/_ibmfair fish/vendor_completions.d/ibmfair.fish)
  file(READ ${WORK}/installed/share/${file} text)
  if(NOT text MATCHES "smooth")
    message(FATAL_ERROR "share/${file} does not tell of \"smooth\"")
  endif()
endforeach()
file(WRITE ${WORK}/one.stl "solid one
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid one
")
# A file that only assimp reads: the installed program must find its helper.
run(${WORK}/installed/bin/ibmfair smooth ${WORK}/one.stl ${WORK}/one.obj --steps 0)

# The program of src/README.md, as it stands there.
file(READ ${CMAKE_CURRENT_LIST_DIR}/../../src/README.md readme)
foreach(block "cmake;CMakeLists.txt" "cpp;main.cpp")
  list(GET block 0 language)
  list(GET block 1 name)
  string(REGEX MATCH "```${language}\n([^`]*)```" found "${readme}")
  file(WRITE ${WORK}/readme/${name} "${CMAKE_MATCH_1}")
endforeach()
build_project(${WORK}/readme ${WORK}/readme-build)
run(${WORK}/readme-build/mine ${CMAKE_CURRENT_LIST_DIR}/../../data/femur.off ${WORK}/fair.off)
run(${WORK}/installed/bin/ibmfair compare ${CMAKE_CURRENT_LIST_DIR}/../../data/femur.off ${WORK}/fair.off)
if(NOT output MATCHES "RMS")
  message(FATAL_ERROR "a comparison expected, not\n${output}")
endif()

# The Python package, where the Python that it was built for looks below the prefix.
if(PYTHON)
  file(GLOB package ${WORK}/installed/lib/python3*/*-packages/ibmfair/__init__.py)
  if(NOT package)
    message(FATAL_ERROR "the Python package is not installed")
  endif()
  string(REGEX REPLACE "/ibmfair/__init__.py$" "" site ${package})
  file(WRITE ${WORK}/first.py "import ibmfair
print(len(ibmfair.make('icosphere')[0]), ibmfair.__file__)
")
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${site} ${PYTHON} ${WORK}/first.py)
  if(NOT output MATCHES "^12 ${site}/ibmfair")
    message(FATAL_ERROR "an icosahedron from ${site} expected, not\n${output}")
  endif()
endif()
