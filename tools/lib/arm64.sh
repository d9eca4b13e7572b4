# Sourced by tools/test: the tests on an emulated arm64 processor.

arm64_directory=build-arm64
arm64_sysroot=$arm64_directory/sysroot
arm64_compiler=aarch64-linux-gnu-g++
arm64_emulator=qemu-aarch64-static  # being static, it leaves LD_PRELOAD to the program that it runs

# make_arm64_sysroot: Debian's arm64 packages that the library, the program and the tests need, of the
# release that this machine runs. The sysroot is made once and kept.
make_arm64_sysroot() {
  [[ -e $arm64_sysroot ]] && return
  local packages=(libc6-dev libeigen3-dev libsuitesparse-dev libspectra-dev libtbb-dev libassimp-dev
                  libpng-dev zlib1g-dev libmeshoptimizer-dev libcli11-dev libfmt-dev
                  nlohmann-json3-dev libgtest-dev libcgal-dev)
  local new=$arm64_sysroot.new
  rm -rf "$new"
  mkdir -p "$new"
  echo "test: making $arm64_sysroot from Debian's arm64 packages"
  # Only /lib and /usr are kept. When a program opens a file, QEMU prefers the file of the same name
  # in the sysroot, but the program must use the /tmp, /dev and /etc of this machine.
  mmdebstrap --quiet --variant=extract --architectures=arm64 --format=tar \
    --include="$(IFS=, && echo "${packages[*]}")" \
    "$(. /etc/os-release && echo "$VERSION_CODENAME")" - |
    tar --extract --directory="$new" --no-same-owner --anchored --exclude='./[!lu]*'
  # In releases of Debian after bookworm, no package brings this link.
  [[ -e $new/lib ]] || ln -s usr/lib "$new/lib"

  # The packages assume that they are installed in the root directory. Their absolute links and the
  # absolute paths in their CMake files must lead into the sysroot instead.
  local link
  find "$new" -lname '/*' | while read -r link; do
    ln --symbolic --force --no-dereference --relative "$new$(readlink "$link")" "$link"
  done
  local libraries=usr/lib/aarch64-linux-gnu
  sed -i -e "s|/$libraries/lib|\${CMAKE_SYSROOT}&|g" -e 's|"/usr"|"${CMAKE_SYSROOT}/usr"|' \
    "$new/$libraries"/cmake/{assimp*,draco}/*argets*.cmake
  # The installation of a BLAS and of a LAPACK would make these links.
  local name
  for name in blas lapack; do
    ln -s "$name/lib$name.so.3" "$new/$libraries/lib$name.so.3"
  done
  mv "$new" "$arm64_sysroot"
}

# with_arm64_programs COMMAND...: runs the command so that arm64 programs start like all others, also
# those that the tests or the program itself start: the kernel starts QEMU for them (binfmt_misc).
# Where this machine does not do so anyway, it is arranged for this command alone, in a namespace.
with_arm64_programs() {
  local -x QEMU_LD_PREFIX=$PWD/$arm64_sysroot
  if "$arm64_directory/ibmfair" --version >/dev/null 2>&1; then
    "$@"
    return
  fi
  local formats=$arm64_directory/binfmt_misc
  mkdir -p "$formats"
  # The bytes at the start of a 64-bit little-endian ELF file for arm64, and which bits of them count.
  # Flags: P passes on the name that the program was called by, F opens QEMU now.
  local bytes='\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00'
  local mask='\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff'
  local line=":arm64:M::$bytes:$mask:$(command -v "$arm64_emulator"):PF"
  local enter=(unshare --user --map-root-user --mount)
  local arrange='mount -t binfmt_misc binfmt_misc "$0" && printf %s "$1" >"$0/register" && shift'
  if ! "${enter[@]}" bash -c "$arrange" "$formats" "$line" 2>/dev/null; then
    echo "test: cannot arrange here that arm64 programs start like all others. This needs Linux 6.7 or" >&2
    echo "  later with user namespaces, or QEMU known to the kernel (package binfmt-support)." >&2
    return 1
  fi
  "${enter[@]}" bash -c "$arrange"' && exec "$@"' "$formats" "$line" "$@"
}

# test_arm64 [CTEST-OPTION...]
test_arm64() {
  tools/setup g++-aarch64-linux-gnu qemu-user-static mmdebstrap uidmap
  print_compiler "$arm64_compiler"
  make_arm64_sysroot
  # -Wno-psabi: otherwise GCC reports many functions whose arguments GCC 9 passed in another way.
  configure "$arm64_directory" --toolchain tools/cmake/arm64.cmake -D CMAKE_BUILD_TYPE=Release \
    -D IBMFAIR_TESTS=ON -D IBMFAIR_PETSC=OFF -D CMAKE_CXX_FLAGS="-Werror -Wno-psabi"
  compile "$arm64_directory"

  # Tests of the sources (lint) do not depend on the processor.
  local results=$PWD/$arm64_directory/tests.xml failed=0
  rm -f "$results"
  with_arm64_programs ctest --test-dir "$arm64_directory" --output-on-failure --no-tests=error \
    --parallel "$cores" --label-exclude 'slow|lint' --output-junit "$results" "$@" || failed=1

  configure build -D CMAKE_BUILD_TYPE=Release
  compile build ibmfair
  # Results of two kernel sets on one processor differ by 1.4e-6, because a last digit can decide
  # where iterations stop. Two processors cannot be expected to agree better.
  echo "test: results on arm64 beside those of $(c++ --version | head -n 1) on $(uname -m)"
  tools/compare_builds build/ibmfair "$arm64_directory/ibmfair" \
    --a-environment IBMFAIR_KERNELS=baseline \
    --launcher "$arm64_emulator -L $arm64_sysroot" --most 1e-5 || failed=1

  # count ATTRIBUTE: a number of the test suite, from the report that ctest wrote.
  count() { sed -n "s/^[[:space:]]*$1=\"\([0-9]*\)\".*/\1/p" "$results" | head -n 1; }
  if [[ -e $results ]]; then
    echo "test: on arm64, emulated by $("$arm64_emulator" --version | head -n 1), compiled by" \
      "$("$arm64_compiler" --version | head -n 1):" \
      "$(($(count tests) - $(count failures) - $(count skipped) - $(count disabled))) tests passed," \
      "$(count skipped) skipped, $(count failures) failed"
  fi
  return "$failed"
}
