# Sourced by the scripts in tools/, which run from the project's root from here on.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

cores=$(nproc 2>/dev/null || sysctl -n hw.ncpu)

# configure DIR [CMAKE-OPTION...]: with Ninja where it is there; DIR keeps the generator it has.
configure() {
  local directory=$1
  shift
  if [[ ! -e $directory/CMakeCache.txt ]] && command -v ninja >/dev/null; then
    set -- -G Ninja "$@"
  fi
  cmake -S . -B "$directory" "$@" >/dev/null
}

# compile DIR [TARGET...]: what is out of date, with all cores.
compile() {
  local directory=$1
  shift
  cmake --build "$directory" --parallel "$cores" --target "${@:-all}"
}
