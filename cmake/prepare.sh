#!/bin/sh
# Brings build/PRESET up to date; what `sh apps/run` and `sh tests/run` do before they run anything.
#
#   sh cmake/prepare.sh PRESET [TARGET]
#
# 1. Installs the packages of cmake/packages.txt that are missing, through apt-get, as root or with sudo. Where that is
#    not possible it names them and goes on: CMake may find the libraries elsewhere.
# 2. Configures, if this folder has not been configured from here with these arguments; a folder left by a checkout that
#    has moved, or by another generator, is configured afresh.
# 3. Builds TARGET, or everything.
#
# A second run goes straight to 3. Everything it says goes to standard error. On a terminal apt-get and Ninja show their
# progress; otherwise what the steps print is shown only if they fail. Ends with 0, or with 1 and the reason.
#
# Environment:
#   VEX_CMAKE_ARGS                more arguments for CMake, split at blanks, as in -DVEX_WARNINGS_AS_ERRORS=ON
#   CMAKE_BUILD_PARALLEL_LEVEL    compile jobs; otherwise one a core, and no more than one for each 1.5 GiB of memory
set -eu
exec </dev/null >&2

preset=$1
target=${2:-all}
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
packages=$root/cmake/packages.txt
build=$root/build/$preset
log=$root/build/$preset.log
stamp=$build/.prepared

say() { printf 'vex: %s\n' "$*" || :; }

has() { command -v "$1" >/dev/null 2>&1; }

# quietly COMMAND...: what it prints is shown only if it fails.
quietly() {
  if ! "$@" >"$log" 2>&1; then
    tail -n 100 "$log"
    return 1
  fi
}

# with_progress COMMAND...: the same, but shown as it comes on a terminal.
with_progress() {
  if [ -t 2 ]; then "$@"; else quietly "$@"; fi
}

# The packages of packages.txt, without and with what is said beside them.
package_names() { sed -n 's/^\([a-z0-9][^[:blank:]]*\).*/\1/p' "$packages"; }
package_list() { sed -n 's/^[a-z0-9]/  &/p' "$packages"; }

missing_packages() {
  # shellcheck disable=SC2046  # one word a package
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $(package_names) 2>/dev/null) || :
  for package in $(package_names); do
    case "
$installed
" in
      *"
installed $package
"*) ;;
      *) printf '%s ' "$package" ;;
    esac
  done
}

# Run by root, with the packages as arguments. Another apt-get is waited for, and a umask of the caller's must not make
# the system's files unreadable to others. Without network the package lists that are there may do.
# shellcheck disable=SC2016  # expanded by the shell that root runs
apt_script='
  umask 022
  export DEBIAN_FRONTEND=noninteractive
  options="-o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0"
  apt-get $options update || echo "vex: apt-get update failed; going on with the package lists that are there"
  exec apt-get $options install -y --no-install-recommends "$@"'

# Fails, with the reason said, if something is missing and cannot be installed.
install_packages() {
  if ! has dpkg-query || ! has apt-get; then
    say "apt-get is not here, so nothing is installed; vex needs (names of the Debian packages first):"
    package_list
    return 1
  fi
  missing=$(missing_packages)
  missing=${missing% }
  if [ -z "$missing" ]; then return 0; fi
  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    if ! has sudo; then
      say "packages are missing, and there is no sudo to install them with; please have root run:"
      say "    apt-get install $missing"
      return 1
    fi
    as_root=sudo
  fi
  say "installing through apt-get${as_root:+ (with sudo)}: $missing"
  # shellcheck disable=SC2086  # one word a package
  if ! with_progress $as_root sh -c "$apt_script" sh $missing; then
    say "they could not be installed; please have root run:"
    say "    apt-get install $missing"
    return 1
  fi
}

# Whether this folder was configured by this script, from here, with these arguments, since the requirements changed.
is_configured() {
  [ -f "$build/build.ninja" ] && [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$configuration" ] &&
    [ -z "$(find "$root/CMakePresets.json" "$root/cmake" -newer "$stamp" -type f)" ]
}

configure() {
  if ! has cmake; then
    say "there is no cmake"
    return 1
  fi
  say "configuring build/$preset"
  # shellcheck disable=SC2086  # split at blanks, as documented
  (set -f && quietly cmake --fresh -S "$root" --preset "$preset" ${VEX_CMAKE_ARGS:-}) || return 1
  printf '%s\n' "$configuration" >"$stamp"
}

# Compile jobs that the cores and the memory (of the machine, or of the container) allow.
parallel_jobs() {
  jobs=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
  memory_kib=$(sed -n 's/^MemAvailable: *\([0-9]*\) kB$/\1/p' /proc/meminfo 2>/dev/null || :)
  for limit in /sys/fs/cgroup/memory.max /sys/fs/cgroup/memory/memory.limit_in_bytes; do
    limit_kib=$(sed -n 's/^\([0-9]*\)[0-9]\{3\}$/\1/p' "$limit" 2>/dev/null || :)
    if [ -n "$limit_kib" ] && [ "$limit_kib" -lt "${memory_kib:-$limit_kib}" ]; then memory_kib=$limit_kib; fi
  done
  if [ -n "$memory_kib" ] && [ $((memory_kib / 1572864)) -lt "$jobs" ]; then jobs=$((memory_kib / 1572864)); fi
  if [ "$jobs" -lt 1 ]; then jobs=1; fi
  echo "$jobs"
}

if ! mkdir -p "$build" 2>/dev/null || ! [ -w "$build" ] || ! : >>"$log"; then
  say "cannot write to $build; please make it writable, or remove it if another user made it"
  exit 1
fi

# Two runs at once would build over each other.
if has flock; then
  exec 9>"$root/build/$preset.lock"
  if ! flock -n 9; then
    say "waiting for another run to finish building"
    flock 9 || :
  fi
fi

configuration="arguments: ${VEX_CMAKE_ARGS:-}
source: $root"
if ! is_configured; then
  rm -f "$stamp"
  packages_complete=yes
  install_packages 9>&- || packages_complete=no
  if ! configure; then
    if [ "$packages_complete" = no ]; then
      say "not built: please install what is named above, then run this again"
    else
      say "not built: CMake could not configure it"
    fi
    exit 1
  fi
fi

say "building build/$preset"
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(parallel_jobs)}
if ! with_progress cmake --build "$build" --target "$target" --parallel "$jobs"; then
  rm -f "$stamp"  # so that the next run looks again for what may be missing
  say "not built: building failed"
  exit 1
fi
