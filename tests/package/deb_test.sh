#!/bin/sh
# Makes the Debian packages and looks at what is in them. Needs neither root nor network.
#
#   sh tests/package/deb_test.sh BUILD_DIR CPACK VERSION PYTHON PROGRAM...      PYTHON is -, where the package is not built
set -eu
build_dir=$1
cpack=$2
version=$3
python=$4
shift 4

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM
export LC_ALL=C

fail() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}
step() { printf -- '- %s\n' "$*"; }

step "CPack makes the packages, whatever the umask"
if ! (cd "$scratch" && umask 077 && "$cpack" -G DEB -B "$scratch" --config "$build_dir/CPackConfig.cmake") >"$scratch/log" 2>&1
then
  cat "$scratch/log"
  fail "cpack"
fi

step "packages made again are the same bytes"
mkdir "$scratch/again"
# Under the same umask, which CPack gives the archive's own members.
(cd "$scratch/again" && umask 077 && "$cpack" -G DEB -B "$scratch/again" --config "$build_dir/CPackConfig.cmake") >"$scratch/log" 2>&1 ||
  fail "cpack"
for package in "$scratch"/*.deb; do cmp "$package" "$scratch/again/$(basename "$package")" || fail "they differ"; done

architecture=$(dpkg --print-architecture)
vex=$scratch/vex_$version-1_$architecture.deb
dev=$scratch/libvex-dev_$version-1_$architecture.deb
set -- "$vex" "$dev" -- "$@"
if [ "$python" != - ]; then
  module=$scratch/python3-vex_$version-1_$architecture.deb
  set -- "$module" "$@"
fi
packages=
while [ "$1" != -- ]; do
  [ -f "$1" ] || fail "no $1"
  packages="$packages $1"
  shift
done
shift

# field PACKAGE NAME PATTERN: an extended regular expression for the whole field.
field() {
  value=$(dpkg-deb -f "$1" "$2")
  printf '%s\n' "$value" | head -n 1 | grep -qxE -e "$3" || fail "$(basename "$1"): $2 is \"$value\""
}

step "control fields"
# shellcheck disable=SC2086  # one word a package: their folder is mktemp's
for package in $packages; do
  field "$package" Version "$version-1"
  field "$package" Architecture "$architecture"
  field "$package" Maintainer '[A-Z][^<]* <[^@]+@[^>]+>'
  field "$package" Priority optional
  field "$package" Installed-Size '[1-9][0-9]*'
  field "$package" Description '[a-z].{10,78}'
  [ "$(dpkg-deb -f "$package" Description | wc -l)" -ge 4 ] || fail "$(basename "$package"): no long description"
done
field "$vex" Package vex
field "$vex" Section science
field "$vex" Depends '.*libassimp5.*'
field "$dev" Package libvex-dev
field "$dev" Section libdevel
for library in libassimp-dev libeigen3-dev libqhull-dev zlib1g-dev; do field "$dev" Depends "(.*, )?$library( .*|,.*)?"; done

if [ "$python" != - ]; then
  field "$module" Package python3-vex
  field "$module" Section python
  field "$module" Depends '.*libassimp5.*'
  field "$module" Depends '.*python3 \(<< 3\.[0-9]+\).*'
  field "$module" Depends '.*python3-numpy.*'
  dpkg-deb -e "$module" "$scratch/control"
  for script in postinst prerm; do
    [ -x "$scratch/control/$script" ] || fail "python3-vex has no $script"
    sh -n "$scratch/control/$script" || fail "python3-vex: $script"
  done
fi

step "files, their owners and permissions"
# shellcheck disable=SC2086
for package in $packages; do
  dpkg-deb -c "$package" >"$scratch/files"
  if grep -vE '^(drwxr-xr-x|-rw-r--r--|-rwxr-xr-x) root/root ' "$scratch/files"; then
    fail "$(basename "$package"): unusual owners or permissions"
  fi
  if grep -E '^-rwx' "$scratch/files" | grep -v '\./usr/bin/'; then fail "executable, but not a program"; fi
  name=$(dpkg-deb -f "$package" Package)
  for file in copyright changelog.Debian.gz; do
    grep -qF "./usr/share/doc/$name/$file" "$scratch/files" || fail "$name: no $file"
  done
  dpkg-deb --fsys-tarfile "$package" | tar -xO "./usr/share/doc/$name/copyright" >"$scratch/copyright"
  for library in vex CLI11 Random123 nlohmann_json Eigen Boost.Math FCL libccd assimp pybind11 three.js; do
    grep -qxE "(Upstream-Name: |Files: )$library(/\*)?" "$scratch/copyright" || fail "$name: no licence of $library"
  done
  # shellcheck disable=SC2013  # licence names have no blanks
  for license in $(sed -n '/^Files:/,/^$/s/^License: //p' "$scratch/copyright"); do
    [ "$(grep -A 3 "^License: $license\$" "$scratch/copyright" | grep -c '^ ')" -ge 3 ] || fail "$name: no text of $license"
  done
  if grep -vE ' (\./|\./usr/((bin|include|lib|share)/(.*)?)?)$' "$scratch/files"; then fail "$name: outside /usr"; fi
done
dpkg-deb -x "$vex" "$scratch/root"
dpkg-deb -x "$dev" "$scratch/dev"
[ -f "$scratch/dev/usr/include/vex/engine/query/overlap.h" ] || fail "libvex-dev has no headers"
[ -n "$(find "$scratch/dev/usr/lib" -name vexConfig.cmake)" ] || fail "libvex-dev has no CMake package"
[ ! -e "$scratch/dev/usr/bin" ] || fail "libvex-dev has programs"
if grep -rlF -e "$build_dir" "$scratch/root" "$scratch/dev"; then fail "these name the build folder"; fi

# What the dependencies of vex install, by the database of installed packages.
# shellcheck disable=SC2016  # dpkg-query's own variables
dpkg-query -W -f='${Package}\t${Provides}\t${Pre-Depends}, ${Depends}\n' >"$scratch/installed"
dpkg-deb -f "$vex" Depends | awk -F '\t' '
  function names(text, list,   n, k) {  # "a (>= 1), b | c:any" -> a b c
    gsub(/\([^)]*\)|:[a-z0-9]+/, "", text)
    n = split(text, list, /[,|[:space:]]+/)
    return n
  }
  FNR == NR {
    depends[$1] = $3
    n = names($2, list)
    for (k = 1; k <= n; ++k) if (list[k] != "") providers[list[k]] = providers[list[k]] " " $1
    next
  }
  {
    n_open = names($0, open)
    while (n_open > 0) {
      package = open[n_open--]
      if (package == "" || package in seen) continue
      seen[package] = 1
      if (package in depends) print package
      n = names(depends[package] " " providers[package], list)
      for (k = 1; k <= n; ++k) open[++n_open] = list[k]
    }
  }' "$scratch/installed" - | sort >"$scratch/closure"

# owner FILE: the package that it belongs to; /lib may be a link to /usr/lib.
owner() {
  for path in "$1" "/usr$1" "${1#/usr}"; do
    if found=$(dpkg-query -S "$path" 2>/dev/null); then
      printf '%s\n' "$found" | sed -n '1s/[:,].*//p'
      return 0
    fi
  done
  return 1
}

for program; do
  step "$program: on a clean system every library would be there"
  path=$scratch/root/usr/bin/$program
  [ -x "$path" ] || fail "no $program in the package"
  [ -f "$scratch/root/usr/share/man/man1/$program.1.gz" ] || fail "no man page"
  file "$path" | grep -q ', stripped' || fail "not stripped"
  if readelf -d "$path" | grep -E 'RPATH|RUNPATH'; then fail "it looks for libraries in folders of its own"; fi
  ldd "$path" >"$scratch/libraries"
  if grep 'not found' "$scratch/libraries"; then fail "a library is missing"; fi
  n_libraries=0
  # shellcheck disable=SC2013  # library names have no blanks
  for library in $(sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p; s/^[[:blank:]]*\(\/[^ ]*\) .*/\1/p' "$scratch/libraries"); do
    package=$(owner "$library") || package=$(owner "$(readlink -f "$library")") || fail "$library is of no package"
    grep -qxF "$package" "$scratch/closure" || fail "$library is of $package, on which vex does not depend"
    n_libraries=$((n_libraries + 1))
  done
  [ "$n_libraries" -ge 3 ] || fail "no libraries found by ldd"
  [ "$(env -i "$path" --version)" = "$program $version" ] || fail "--version"
done

if [ "$python" != - ]; then
  step "the Python package works from its .deb alone"
  dpkg-deb -x "$module" "$scratch/python"
  folder=$scratch/python/usr/lib/python3/dist-packages
  [ -f "$folder/vex/py.typed" ] || fail "no py.typed"
  if find "$scratch/python" -name '__pycache__' | grep .; then fail "compiled files of somebody's Python"; fi
  if grep -rlF -e "$build_dir" "$scratch/python"; then fail "these name the build folder"; fi
  if readelf -d "$folder"/vex/_vex*.so | grep -E 'RPATH|RUNPATH'; then fail "it looks for libraries in folders of its own"; fi
  env -i PYTHONPATH="$folder" PYTHONDONTWRITEBYTECODE=1 "$python" -c '
import vex
assert vex.__file__.startswith("'"$folder"'"), vex.__file__
r = vex.excluded_volume("box:1,1,1", trials=20000)
assert r.formula == 11.0 and abs(r.z) < 6, r' || fail "import vex"
fi

step "vex_mesh measures a body in an empty environment"
env -i "$scratch/root/usr/bin/vex_mesh" box:1,1,1 --trials 20000 >"$scratch/report" || fail "exit code $?"
grep -qE '^ *<V_ex>, formula +11(\.0*)?$' "$scratch/report" || { cat "$scratch/report"; fail "two unit cubes: 11"; }

step "vex_mesh asks FCL in an empty environment"
if [ -e "$build_dir/lib/vex/fcl.so" ]; then
  env -i "$scratch/root/usr/bin/vex_mesh" box:1,1,1 --backend fcl --trials 1000 >"$scratch/report" || fail "exit code $?"
  grep -q 'peer 100 %' "$scratch/report" || { cat "$scratch/report"; fail "two unit cubes by FCL"; }
fi

step "vex_pair answers in an empty environment"
env -i "$scratch/root/usr/bin/vex_pair" box:1,1,1 box:1,1,1 --translation 0.5,0,0 >"$scratch/report" || fail "exit code $?"
grep -q 'OVERLAP' "$scratch/report" || { cat "$scratch/report"; fail "two cubes half an edge apart"; }

step "vex_paper computes a table in an empty environment"
env -i "$scratch/root/usr/bin/vex_paper" --table 1 --trials 2000 --max-z 100 >"$scratch/report" || fail "exit code $?"
grep -qE '^ *1e-6 +2000007 ' "$scratch/report" || { cat "$scratch/report"; fail "the row of ratio 1e-6"; }

step "vex_merge puts two ranges together in an empty environment"
for k in 0 1; do
  env -i "$scratch/root/usr/bin/vex_mesh" box:1,1,1 --estimator radial --first-trial $((k * 3200)) --trials 3200 --quiet \
    --json "$scratch/$k.json" || fail "exit code $?"
done
env -i "$scratch/root/usr/bin/vex_merge" "$scratch/0.json" "$scratch/1.json" --trials 6400 >"$scratch/report" || fail "exit code $?"

step "vex_stress judges a stratum in an empty environment"
env -i "$scratch/root/usr/bin/vex_stress" --stratum random/cubes --pairs 100 >"$scratch/report" || fail "exit code $?"
grep -q 'gjk: 0 wrong' "$scratch/report" || { cat "$scratch/report"; fail "a wrong answer"; }

if command -v lintian >/dev/null; then
  step "lintian"
  allow_root=
  if [ "$(id -u)" -eq 0 ]; then allow_root=--allow-root; fi
  # initial-upload-closes-no-bugs: the package is not uploaded to Debian.
  # wrong-name-for-upstream-changelog: the documentation's links call it CHANGELOG.md.
  lintian $allow_root --suppress-tags initial-upload-closes-no-bugs,wrong-name-for-upstream-changelog \
    --fail-on error,warning $packages || fail "lintian"
fi
echo "all expectations met"
