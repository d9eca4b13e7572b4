# Sourced by the scripts in tools/; changes to the root folder of the project.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cores=$(nproc 2>/dev/null || sysctl -n hw.ncpu)

# configure DIR [CMAKE-OPTION...]: with Ninja if installed; an existing DIR keeps its generator.
configure() {
  local directory=$1
  shift
  if [[ ! -e $directory/CMakeCache.txt ]] && command -v ninja >/dev/null; then
    set -- -G Ninja "$@"
  fi
  cmake -S . -B "$directory" "$@" >/dev/null
}

# compile DIR [TARGET...]: builds what is out of date, with all cores.
compile() {
  local directory=$1
  shift
  cmake --build "$directory" --parallel "$cores" --target "${@:-all}"
}

# The compiler of the builds with sanitizers; llvm provides the names in stack traces.
clang=16
clang_packages=("clang-$clang" "libclang-rt-$clang-dev" "llvm-$clang")

# configure_sanitized: build-sanitize/, by clang with AddressSanitizer and UndefinedBehaviorSanitizer
# (alignment included), and for libFuzzer.
configure_sanitized() {
  configure build-sanitize -D CMAKE_CXX_COMPILER="clang++-$clang" -D CMAKE_C_COMPILER="clang-$clang" \
    -D CMAKE_BUILD_TYPE=RelWithDebInfo -D CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -D IBMFAIR_FUZZ=ON \
    -D IBMFAIR_TESTS=ON
  export UBSAN_OPTIONS=print_stacktrace=1 ASAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-$clang
}
