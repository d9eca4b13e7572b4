# CHOLMOD, for --solver cholmod and the scheme as published (--plain). Its supernodal part is under
# the GPL. The program does not link it but loads it when it is first used, and goes without it where
# it is not installed.
option(IBMFAIR_CHOLMOD "Build the solver cholmod (needs SuiteSparse's CHOLMOD to be installed)" ON)

find_package(CHOLMOD QUIET)
if(IBMFAIR_CHOLMOD AND NOT CHOLMOD_FOUND)
  message(FATAL_ERROR "CHOLMOD was not found (Debian: libsuitesparse-dev); -D IBMFAIR_CHOLMOD=OFF "
                      "builds the program without the solver cholmod")
endif()
