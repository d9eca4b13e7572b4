# The page that reports are written into: bundled by npm into one file, report_page.html, which the
# program holds. Sets IBMFAIR_REPORT_PAGE_FILE, empty where there is no page, and the target
# report_page, which makes it.
set(IBMFAIR_REPORT_PAGE "" CACHE STRING
    "A report page that is ready, OFF for none; by default it is built with npm")
set(IBMFAIR_REPORT_PAGE_FILE "")

set(page_sources ${PROJECT_SOURCE_DIR}/src/report_page)
set(page_build ${PROJECT_BINARY_DIR}/report_page)

# npm_install RESULT: what the page is bundled with, unless it is there from an earlier time. Done
# here and not while building, so that a machine without network builds the rest.
function(npm_install result)
  set(${result} OFF PARENT_SCOPE)
  find_program(NPM npm DOC "Installs what the report page is bundled with")
  find_program(NODE NAMES node nodejs DOC "Bundles the report page")
  set(version v0)
  if(NODE)
    execute_process(COMMAND ${NODE} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
  string(REPLACE "v" "" version "${version}")
  if(NOT NPM OR version VERSION_LESS 18)
    message(WARNING "npm and Node.js 18 are not there, so this build has no report page (--report "
                    "FILE.html, view). Install them, or give -D IBMFAIR_REPORT_PAGE=FILE or OFF.")
    return()
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
               ${page_sources}/package.json ${page_sources}/package-lock.json)
  set(omitted)
  if(NOT IBMFAIR_TESTS)
    set(omitted --omit=dev)
  endif()
  file(SHA256 ${page_sources}/package-lock.json wanted)
  string(APPEND wanted " ${omitted}")
  set(stamp ${page_build}/installed)
  set(installed)
  if(EXISTS ${stamp})
    file(READ ${stamp} installed)
  endif()
  if(NOT "${installed}" STREQUAL wanted)
    message(STATUS "Installing what the report page is bundled with (npm)")
    file(REMOVE ${stamp})
    file(COPY ${page_sources}/package.json ${page_sources}/package-lock.json
         DESTINATION ${page_build})
    execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund ${omitted}
                    WORKING_DIRECTORY ${page_build} RESULT_VARIABLE failed
                    OUTPUT_VARIABLE said ERROR_VARIABLE said TIMEOUT 600)
    if(failed)
      message(WARNING "npm could not install what the report page is bundled with, so this build "
                      "has none (--report FILE.html, view). Without network, give "
                      "-D IBMFAIR_REPORT_PAGE=FILE or OFF.\n${said}")
      return()
    endif()
    file(WRITE ${stamp} "${wanted}")
  endif()
  set(${result} ON PARENT_SCOPE)
endfunction()

# build_page FILE: bundles a copy of the sources, beside whose folder npm's packages are found.
function(build_page file)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${page_sources}/*)
  add_custom_command(
    OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${page_build}/sources
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${page_sources} ${page_build}/sources
    COMMAND ${NODE} ${page_build}/node_modules/vite/bin/vite.js build ${page_build}/sources
            --config ${page_build}/sources/vite.config.ts --logLevel warn
            --outDir ${page_build}/bundle --emptyOutDir
    COMMAND ${CMAKE_COMMAND} -E copy ${page_build}/bundle/index.html ${file}
    DEPENDS ${sources}
    COMMENT "Bundling the report page"
    VERBATIM)
endfunction()

if(IBMFAIR_REPORT_PAGE STREQUAL "")
  npm_install(page_can_be_built)
  if(page_can_be_built)
    set(IBMFAIR_REPORT_PAGE_FILE ${PROJECT_BINARY_DIR}/report_page.html)
    build_page(${IBMFAIR_REPORT_PAGE_FILE})
  endif()
elseif(IBMFAIR_REPORT_PAGE)
  get_filename_component(IBMFAIR_REPORT_PAGE_FILE "${IBMFAIR_REPORT_PAGE}" ABSOLUTE
                         BASE_DIR ${CMAKE_BINARY_DIR})
  if(NOT EXISTS "${IBMFAIR_REPORT_PAGE_FILE}")
    message(FATAL_ERROR "IBMFAIR_REPORT_PAGE: there is no file ${IBMFAIR_REPORT_PAGE_FILE}")
  endif()
endif()

if(IBMFAIR_REPORT_PAGE_FILE)
  add_custom_target(report_page ALL DEPENDS ${IBMFAIR_REPORT_PAGE_FILE})
endif()
