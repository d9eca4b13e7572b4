# Has PROGRAM write its man pages and completions below DIRECTORY, where they belong below share/.
#   cmake -D PROGRAM=... -D DIRECTORY=... -P write_usage.cmake
cmake_minimum_required(VERSION 3.25)

function(write_file file)
  get_filename_component(folder ${DIRECTORY}/${file} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${DIRECTORY}/${file}
                  COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${DIRECTORY})
write_file(bash-completion/completions/ibmfair --generate bash)
write_file(zsh/site-functions/_ibmfair --generate zsh)
write_file(fish/vendor_completions.d/ibmfair.fish --generate fish)
write_file(man/man1/ibmfair.1 --generate man)
execute_process(COMMAND ${PROGRAM} --json-usage OUTPUT_VARIABLE usage COMMAND_ERROR_IS_FATAL ANY)
string(JSON count LENGTH "${usage}" commands)
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON command GET "${usage}" commands ${i} name)
  write_file(man/man1/ibmfair-${command}.1 ${command} --generate man)
endforeach()
