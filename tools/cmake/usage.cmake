# Man pages and completions for shells, which the program writes itself once it is built; where it is
# built for another kind of processor, in the emulator of the toolchain file.
set(usage_directory ${PROJECT_BINARY_DIR}/share)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/usage.stamp
  COMMAND ${CMAKE_COMMAND} -D "PROGRAM=${CMAKE_CROSSCOMPILING_EMULATOR};$<TARGET_FILE:ibmfair>"
          -D DIRECTORY=${usage_directory}
          -P ${CMAKE_CURRENT_LIST_DIR}/write_usage.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/usage.stamp
  DEPENDS ibmfair ${CMAKE_CURRENT_LIST_DIR}/write_usage.cmake
  VERBATIM COMMENT "Writing man pages and completions")
add_custom_target(usage_files ALL DEPENDS ${PROJECT_BINARY_DIR}/usage.stamp)
