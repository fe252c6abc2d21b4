#!/bin/sh
# The packages on a Debian 12 that has nothing else: makes one in a temporary folder, installs vex and runs it, then
# installs libvex-dev and builds tests/consumer with it, then python3-vex and runs its tests, and removes the folder. Not part of the tests: it needs root,
# the network, debootstrap, 1.5 GiB of disk and some minutes.
#
#   sh tests/package/clean_system.sh BUILD_DIR      a release build, with everything built
#
# Environment:
#   VEX_MIRROR    the Debian mirror (default: http://deb.debian.org/debian)
#   VEX_SUITE     the Debian release (default: bookworm)
#   TMPDIR        where the folder is made; it must allow programs and devices (default: /tmp)
set -eu
source_dir=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd -P)
build_dir=$(CDPATH='' cd -- "${1:?the build folder}" && pwd -P)
mirror=${VEX_MIRROR:-http://deb.debian.org/debian}
suite=${VEX_SUITE:-bookworm}
umask 022

started=$(date +%s)
step() { printf -- '- %s s: %s\n' "$(($(date +%s) - started))" "$*"; }
fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}
[ "$(id -u)" -eq 0 ] || fail "only root can make a system"
command -v debootstrap >/dev/null || fail "debootstrap is missing - apt-get install debootstrap"

scratch=$(mktemp -d)
root=$scratch/root
remove_all() {
  umount "$root/proc" 2>/dev/null || :
  rm -rf --one-file-system "$scratch"
}
trap remove_all EXIT
trap 'exit 1' HUP INT TERM
# quietly COMMAND...: what it prints is shown only if it fails.
quietly() {
  if ! "$@" >"$scratch/log" 2>&1; then
    tail -n 50 "$scratch/log"
    fail "$*"
  fi
}
# inside COMMAND...: in the new system, with nothing of this one's environment but what leads to the mirror.
inside() {
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    ${http_proxy:+http_proxy="$http_proxy"} "$@"
}

step "the packages"
(cd "$scratch" && quietly cpack -G DEB -B "$scratch" --config "$build_dir/CPackConfig.cmake")

step "a minimal system"
quietly debootstrap --variant=minbase "$suite" "$root" "$mirror"
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc" 2>/dev/null || :
mkdir "$root/packages"
cp "$scratch"/*.deb "$root/packages/"

step "vex, with its dependencies"
quietly inside apt-get update
quietly inside sh -c 'apt-get install -y --no-install-recommends /packages/vex_*.deb'
inside vex_mesh --version || fail "vex_mesh --version"
inside vex_mesh box:1,1,1 --rel-error 1e-3 >"$scratch/report" || fail "vex_mesh box:1,1,1"
grep '^z = .* agree$' "$scratch/report" || fail "Monte Carlo and formula"
cp "$source_dir/meshes/data/pebble.obj" "$root/packages/"
inside vex_mesh /packages/pebble.obj --rel-error 1e-3 >"$scratch/report" || fail "vex_mesh pebble.obj"
grep '^z = .* agree$' "$scratch/report" || fail "Monte Carlo and formula"

step "its man page"
quietly inside apt-get install -y --no-install-recommends man-db
inside man vex_mesh >"$scratch/page" || fail "man vex_mesh"
grep -q -e '--rel-error E' "$scratch/page" || fail "the man page says nothing"

step "libvex-dev, with its dependencies"
quietly inside sh -c 'apt-get install -y --no-install-recommends /packages/libvex-dev_*.deb g++ cmake make'
cp -R "$source_dir/tests/consumer" "$root/packages/consumer"
quietly inside cmake -S /packages/consumer -B /packages/build -DCMAKE_BUILD_TYPE=Release
quietly inside cmake --build /packages/build --parallel 2
inside /packages/build/superellipsoid 1 1 1 4 1 || fail "superellipsoid"
inside /packages/build/mesh_and_shape /packages/pebble.obj sphere:1 || fail "mesh_and_shape"

step "python3-vex, with its dependencies, and the tests of the package"
quietly inside sh -c 'apt-get install -y --no-install-recommends /packages/python3-vex_*.deb python3-matplotlib \
  python3-pytest python3-hypothesis python3-scipy'
mkdir -p "$root/packages/vex/meshes" "$root/packages/vex/docs"
cp -R "$source_dir/tests" "$root/packages/vex/tests"
cp -R "$source_dir/meshes/data" "$root/packages/vex/meshes/data"
cp -R "$source_dir/docs/notebooks" "$root/packages/vex/docs/notebooks"
cp "$source_dir/docs/python.md" "$source_dir/docs/guide.md" "$root/packages/vex/docs/"
inside sh -c 'cd /packages/vex/tests/python && VEX_PROGRAMS=/usr/bin MPLBACKEND=agg python3 -m pytest -q -p no:cacheprovider' ||
  fail "the tests of the Python package"

step "removed cleanly"
quietly inside apt-get purge -y vex libvex-dev python3-vex
if find "$root/usr" "$root/etc" "$root/var" \( -name vex -o -name 'vex[._-]*' -o -name 'libvex*' -o -name 'python3-vex*' \) ! -path '*/var/log/*' ! -path '*/var/cache/*' | grep .; then
  fail "these were left"
fi

step "all expectations met"
