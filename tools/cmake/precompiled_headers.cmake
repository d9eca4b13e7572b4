# Two thirds of the compiling time go into reading the same few headers. Sources include what they
# need all the same: tools/lint checks them without this.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  # A compiler cache keeps nothing that was compiled with them.
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

set(precompiled_by_all <algorithm> <filesystem> <functional> <string> <vector> <Eigen/Core>
                       <Eigen/Geometry> <fmt/format.h>)
target_precompile_headers(ibmfair_library PRIVATE ${precompiled_by_all})
target_precompile_headers(ibmfair PRIVATE <CLI/CLI.hpp> <nlohmann/json.hpp> ${precompiled_by_all})
