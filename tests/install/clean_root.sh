#!/usr/bin/env bash
# Installs the packages that `cpack` made into empty Debian systems and runs the demo there: the .deb
# with what it says it depends on, those of the engine for many machines and for Python beside it, the
# tarball with the libraries of those packages alone, and a project of another's with the library's
# package.
#
#   clean_root.sh BUILD WORK
#
# Ends with 77 (skipped) where no empty Debian can be made.
set -euo pipefail
build=$(realpath "$1") work=$2 here=$(realpath "$(dirname "$0")")

skip() { echo "skipped: $*"; exit 77; }
command -v mmdebstrap >/dev/null && command -v dpkg-shlibdeps >/dev/null || skip "no mmdebstrap, no dpkg-dev"
((EUID == 0)) || skip "not root"
release=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")

rm -rf --one-file-system "$work"  # no mounts that a killed run has left
mkdir -p "$work/packages"
work=$(realpath "$work")
cpack --config "$build/CPackConfig.cmake" -B "$work/packages" >"$work/cpack.log" || {
  cat "$work/cpack.log"
  exit 1
}
program=$(ls "$work"/packages/ibmfair_*.deb) library=$(ls "$work"/packages/libibmfair-dev_*.deb)
tarball=$(ls "$work"/packages/ibmfair-*.tar.gz)

mmdebstrap --quiet --variant=minbase --include=ca-certificates "$release" "$work/root"
inside() { chroot "$work/root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C "$@"; }
apt() { inside DEBIAN_FRONTEND=noninteractive apt-get --quiet=2 --yes --no-install-recommends "$@"; }
trap 'rm -rf --one-file-system "$work/root"' EXIT
apt update

# What the demo must show: vertices moved, and a picture that is a PNG file.
demo() {
  local prefix=$1
  rm -rf --one-file-system "$work"/root/tmp/*  # Open MPI 5 leaves folders there
  inside "$prefix/bin/ibmfair" smooth "$prefix/share/ibmfair/femur.off" /tmp/fair.off \
    --steps 16 --cutoff 4 --picture /tmp/fair.png --json >"$work/demo.json"
  grep --quiet '"status": "completed"' "$work/demo.json"
  [[ $(head --bytes=4 "$work/root/tmp/fair.png" | tail --bytes=3) == PNG ]]
  # A file that only the helper can read.
  printf '%s\n' "solid one" "facet normal 0 0 1" "outer loop" "vertex 0 0 0" "vertex 1 0 0" \
    "vertex 0 1 0" "endloop" "endfacet" "endsolid one" >"$work/root/tmp/one.stl"
  inside "$prefix/bin/ibmfair" smooth /tmp/one.stl /tmp/one.obj --steps 0 --quiet
  # CHOLMOD, which is loaded and not linked.
  inside "$prefix/bin/ibmfair" smooth "$prefix/share/ibmfair/femur.off" /tmp/plain.off \
    --plain --cutoff 2 --json >"$work/plain.json"
  grep --quiet '"solver": "cholmod"' "$work/plain.json"
}

echo "the Debian package"
cp "$program" "$work/root/root/program.deb"
apt install /root/program.deb
demo /usr

engine=$(ls "$work"/packages/ibmfair-petsc_*.deb 2>/dev/null || true)
if [[ $engine ]]; then
  echo "the package of the engine for many machines"
  cp "$engine" "$work/root/root/engine.deb"
  apt install /root/engine.deb
  inside OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 /usr/bin/ibmfair smooth \
    /usr/share/ibmfair/femur.off /tmp/shared.ply --engine petsc --steps 2 --quiet
  [[ -s $work/root/tmp/shared.ply ]]
fi

python=$(ls "$work"/packages/python3-ibmfair_*.deb 2>/dev/null || true)
if [[ $python ]]; then
  echo "the package for Python"
  cp "$python" "$work/root/root/python.deb"
  apt install /root/python.deb
  cp "$here/../../tools/python_tour.py" "$work/root/root"
  inside python3 -c "import ibmfair; print('ibmfair', ibmfair.__version__, 'in', ibmfair.__file__)"
  inside python3 /root/python_tour.py /tmp/tour >"$work/tour.txt"
  grep --quiet "all above 0: True" "$work/tour.txt"
  grep --quiet "no scipy" "$work/tour.txt"
fi

echo "the tarball, moved"
apt remove ibmfair  # its libraries stay
[[ ! -e $work/root/usr/bin/ibmfair ]]
mkdir "$work/root/opt/fair"
tar --extract --gzip --file "$tarball" --directory "$work/root/opt/fair" --strip-components=1
demo /opt/fair

echo "the library's package"
cp "$library" "$work/root/root/library.deb"
cp -r "$here" "$work/root/root/project"
apt install /root/library.deb cmake g++ make
inside cmake -S /root/project -B /root/build -D CMAKE_BUILD_TYPE=Release >"$work/project.log"
inside cmake --build /root/build >>"$work/project.log"
inside /root/build/uses_ibmfair | grep --quiet "energy 25\.1"  # 8 pi
