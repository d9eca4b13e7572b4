# Sourced by tools/test: the tests in a Debian system of their own.

# test_debian RELEASE [CTEST-OPTION...]: makes a system of that release of Debian (bookworm, trixie),
# and in it builds the last commit and runs the quick tests. Without options for ctest, it also makes
# the Debian packages there and tries each in another, empty system. Needs root.
#
#   build-RELEASE/root                the system
#   build-RELEASE/root/root/ibmfair   the clone of the project, with its build
#   build-RELEASE/log                 what the last build and its tests printed
#
# All of it is kept for the next run. Remove build-RELEASE/root to get newer packages.
#
# Fails if a test fails or if the build prints a warning. The last line says what was run on what.
test_debian() {
  release=${1-}
  if [[ ! $release =~ ^[a-z]+$ ]]; then
    echo "test: --debian needs the name of a release, as in --debian trixie" >&2
    return 1
  fi
  shift
  if ((EUID != 0)); then
    echo "test: --debian must be run as root, because it makes a Debian system" >&2
    return 1
  fi
  tools/setup mmdebstrap
  mkdir -p "build-$release"
  directory=$(realpath "build-$release")
  root=$directory/root log=$directory/log clone=$directory/root/root/ibmfair

  make_debian_root
  update_debian_clone
  # Installed before the build, so that the log has no messages of apt.
  (($#)) && packaging=() || packaging=(dpkg-dev file mmdebstrap)
  in_debian tools/setup "${packaging[@]}"

  failed=0
  in_debian tools/test --quick --output-junit /root/ibmfair/build/quick.xml "$@" 2>&1 |
    tee "$log" || failed=1
  if ((${#packaging[@]})) && [[ -e $clone/build/quick.xml ]]; then
    in_debian ctest --test-dir build --output-on-failure --no-tests=error --tests-regex '^install\.' \
      --output-junit /root/ibmfair/build/install.xml 2>&1 | tee --append "$log" || failed=1
  fi
  if build_warnings >/dev/null; then
    echo "test: the build printed warnings:" >&2
    build_warnings >&2
    failed=1
  fi
  describe_debian_run
  return $failed
}

# in_debian COMMAND...: runs it in the clone, with a clean environment. The mounts are made in a
# namespace of their own. They end with the command, however it ends, and no other process sees them,
# so that removing the system cannot remove anything through them.
in_debian() {
  # shellcheck disable=SC2016  # expanded by the inner shell
  unshare --mount sh -ec '
    root=$1
    shift
    mount -t proc proc "$root/proc"
    mount -t sysfs -o ro sysfs "$root/sys"
    mount -t devpts -o newinstance,ptmxmode=666 devpts "$root/dev/pts"
    mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
    exec chroot "$root" env -i --chdir=/root/ibmfair HOME=/root LC_ALL=C.UTF-8 \
      PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"' sh "$root" "$@"
}

# The system, unless it is there. It gets its name once it is complete.
make_debian_root() {
  if [[ ! -e $root ]]; then
    rm -rf --one-file-system "$root.partial"
    # Without unsafe-io, dpkg waits for the disk after each file; that takes minutes.
    unshare --mount mmdebstrap --variant=minbase --include=ca-certificates,git \
      --dpkgopt=force-unsafe-io "$release" "$root.partial"
    # Certificates that the administrator of this system has added, such as that of a proxy.
    if [[ -d /usr/local/share/ca-certificates ]]; then
      cp -r /usr/local/share/ca-certificates "$root.partial/usr/local/share/"
      chroot "$root.partial" update-ca-certificates
    fi
    mv "$root.partial" "$root"
  fi
  cp --dereference /etc/resolv.conf /etc/hosts "$root/etc/"
}

# The last commit, in the clone of the last run if there is one.
update_debian_clone() {
  if [[ -n $(git status --porcelain) ]]; then
    echo "test: there are changes that are not committed; --debian tests the last commit" >&2
  fi
  [[ -e $clone/.git ]] || git init --quiet "$clone"
  git -C "$clone" fetch --quiet "$PWD" HEAD
  git -C "$clone" reset --quiet --hard FETCH_HEAD
  git -C "$clone" clean --quiet --force -d
  # A build says its warnings once. After a run with warnings, everything is compiled again.
  if [[ -e $log ]] && build_warnings >/dev/null; then
    rm -rf --one-file-system "$clone/build"
  fi
  rm -f "$clone"/build/{quick,install}.xml
}

# The warnings of CMake, compilers and linkers: those in the log before the tests begin. Fails if
# there are none.
build_warnings() {
  sed '/^Internal ctest changing into directory/,$d' "$log" | grep -E 'warning:|^CMake .*Warning'
}

describe_debian_run() {
  if [[ ! -e $clone/build/quick.xml ]]; then
    echo "test: no tests were run on Debian $release, see $log" >&2
    return
  fi
  local commit compiler processor kernels
  commit=$(git -C "$clone" rev-parse --short HEAD)
  compiler=$(in_debian g++ --version | sed -n 1p)
  processor=$(lscpu | sed -n 's/^Model name: *//p')
  kernels=$(in_debian build/ibmfair --version | sed -n 's/^ *kernels //p')
  echo "test: commit $commit on Debian $release $(<"$root/etc/debian_version"), $compiler, $processor," \
    "kernels $kernels: $(count_tests run) tests passed, $(count_tests notrun) skipped," \
    "$(count_tests fail) failed"
}

# count_tests STATUS: number of tests in all runs of ctest, from their reports in JUnit's format.
count_tests() {
  cat "$clone"/build/{quick,install}.xml 2>/dev/null | grep --count "status=\"$1\"" || true
}
