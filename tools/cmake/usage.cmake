# Man pages and completions for shells, which the program writes itself once it is built.
set(usage_directory ${PROJECT_BINARY_DIR}/share)
add_custom_command(
  OUTPUT ${PROJECT_BINARY_DIR}/usage.stamp
  COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:ibmfair> -D DIRECTORY=${usage_directory}
          -P ${CMAKE_CURRENT_LIST_DIR}/write_usage.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/usage.stamp
  DEPENDS ibmfair ${CMAKE_CURRENT_LIST_DIR}/write_usage.cmake
  COMMENT "Writing man pages and completions")
add_custom_target(usage_files ALL DEPENDS ${PROJECT_BINARY_DIR}/usage.stamp)
