#!/bin/sh
# Installs vex, moves the installation, and builds and runs a project that uses it (tests/consumer).
#
#   sh tests/package/consumer_test.sh SOURCE_DIR BUILD_DIR CMAKE CACHE GENERATOR CXX EIGEN_INCLUDE_DIR
#
# CACHE is an initial cache: compiler, flags and where to look for packages.
set -eu
source_dir=$1
build_dir=$2
cmake=$3
cache=$4
generator=$5
cxx=$6
eigen=$7
unset DESTDIR vex_DIR

# shellcheck source=tests/package/steps.sh
. "$(dirname -- "$0")/steps.sh"

step "install, and move what was installed"
quietly "$cmake" --install "$build_dir" --prefix "$scratch/installed"
mkdir "$scratch/moved to"
mv "$scratch/installed" "$scratch/moved to/prefix"
prefix=$scratch/"moved to"/prefix

step "nothing installed names a folder of this machine"
# Whole strings of a binary file, and paths below; a folder's name alone may be as common as /vex.
if grep -rlzxF -e "$source_dir" -e "$build_dir" "$prefix"; then fail "these do"; fi
# After a letter or a dot, as in include/vex/engine/, it is not a path of this machine.
pattern="\\Q$scratch\\E"
for folder in engine shapes meshes apps cmake CMakeFiles bin; do
  for path in "$source_dir/$folder/" "$build_dir/$folder/"; do pattern="$pattern|(?<![\\w.}/-])\\Q$path\\E"; done
done
if LC_ALL=C grep -rlaP -e "$pattern" "$prefix"; then fail "these do"; fi

step "headers are the public ones with what they include, and include each other as <vex/...>"
[ "$(ls "$prefix/include")" = vex ] || fail "include/ holds more than vex/"
(cd "$prefix/include/vex" && find . -name '*.h' | sort) >"$scratch/headers"
sed -n '/^[a-z]/s,^,./,p' "$source_dir/cmake/public_headers.txt" | sort >"$scratch/public"
comm -13 "$scratch/headers" "$scratch/public" >"$scratch/missing"
[ ! -s "$scratch/missing" ] || fail "public headers that are not installed: $(tr '\n' ' ' <"$scratch/missing")"
if grep -E 'kernel|packet_(core|search)|radial_|/formats/|/estimators/core_' "$scratch/headers"; then
  fail "internals are installed"
fi
if grep -rnE '#include "(engine|shapes|meshes|apps|tests)/' "$prefix/include"; then fail "an include is not rewritten"; fi

step "every header compiles on its own"
# shellcheck disable=SC2016  # expanded by the shell that xargs starts
(cd "$prefix/include" && find vex -name '*.h' -print0 |
  xargs -0 -n 8 -P 2 sh -c 'cxx=$1 eigen=$2; shift 2
    for header; do
      echo "#include <$header>" | "$cxx" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I. -isystem "$eigen" -x c++ - || exit 255
    done' sh "$cxx" "$eigen") || fail "one does not"

# configure FOLDER ARGUMENTS...
configure() {
  folder=$1
  shift
  quietly "$cmake" -C "$cache" -G "$generator" -S "$source_dir/tests/consumer" -B "$scratch/$folder" \
    -Dvex_ROOT="$prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF "$@"
}

step "the engine alone needs neither assimp nor Qhull"
configure engine_only -DCONSUMER_ENGINE_ONLY=ON -DCMAKE_DISABLE_FIND_PACKAGE_assimp=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_Qhull=ON
if (configure broken -DCMAKE_DISABLE_FIND_PACKAGE_assimp=ON) >/dev/null; then fail "meshes do without assimp"; fi

step "an unknown component is named"
mkdir "$scratch/typo"
cat >"$scratch/typo/CMakeLists.txt" <<'PROJECT'
cmake_minimum_required(VERSION 3.25)
project(typo LANGUAGES CXX)
find_package(vex 0.1 REQUIRED COMPONENTS engine OPTIONAL_COMPONENTS later)
if(vex_later_FOUND OR NOT vex_engine_FOUND)
  message(FATAL_ERROR "optional components")
endif()
find_package(vex 0.1 QUIET COMPONENTS mesh)
if(vex_FOUND)
  message(FATAL_ERROR "mesh was found")
endif()
find_package(vex 0.1 REQUIRED COMPONENTS mesh)
PROJECT
if "$cmake" -C "$cache" -G "$generator" -S "$scratch/typo" -B "$scratch/typo/build" -Dvex_ROOT="$prefix" >"$scratch/log" 2>&1 ||
  ! grep -q 'no component "mesh"' "$scratch/log"; then
  cat "$scratch/log"
  fail "find_package(vex COMPONENTS mesh)"
fi

step "a project with all of it builds"
configure all
quietly "$cmake" --build "$scratch/all" --parallel 2
commands=$scratch/all/compile_commands.json
grep -q -e '-ffp-contract=off' "$commands" || fail "templates would not round as the project's own do"
# The user's own flags are in the commands too: what vex adds stands in its targets.
find "$prefix" -name 'vex_*.cmake' -exec cat {} + | grep -E 'INTERFACE_(COMPILE|LINK)_OPTIONS' >"$scratch/options"
if grep -vE '"\\\$<\\\$<COMPILE_LANG_AND_ID:[A-Za-z,]+>:-ffp-contract=off>"' "$scratch/options"; then
  fail "options that are the project's alone"
fi

# near TRUTH VALUE STD_ERROR: within four standard errors, which are small enough to tell.
near() {
  awk -v truth="$1" -v value="$2" -v error="$3" 'BEGIN {
    z = (value - truth) / error
    exit !(error > 0 && error < 0.003 * truth && z < 4 && z > -4)
  }'
}

step "its body gets the excluded volume that it should"
# Truths: superellipsoid_truth.py; for p = 2 eight volumes of the unit ball.
while read -r a b c p truth; do
  result=$("$scratch/all/superellipsoid" "$a" "$b" "$c" "$p" 1) || fail "superellipsoid $a $b $c $p"
  printf '  %s: %s, true %s\n' "$a $b $c $p" "$result" "$truth"
  # shellcheck disable=SC2086  # three words
  set -- $result
  near "$truth" "$1" "$2" || fail "not the true value"
  [ "$3" -eq 0 ] || fail "undecided trials"
  if near "$(awk -v t="$truth" 'BEGIN { print 1.01 * t }')" "$1" "$2"; then fail "an error of 1 % goes unseen"; fi
done <<'TRUTHS'
1 1 1 2 33.5103216383
1 1 1 4 55.4100439343
1 0.8 0.6 4 27.7489623114
TRUTHS

step "a mesh and a named body"
cat >"$scratch/cube.obj" <<'CUBE'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
CUBE
result=$("$scratch/all/mesh_and_shape" "$scratch/cube.obj" box:1,1,1) || fail "mesh_and_shape"
[ "$result" = "11 overlap" ] || fail "two unit cubes: $result"

step "the front door, from one header; a hull of points; what is no body is refused"
"$scratch/all/front_door" || fail "front_door: the run disagrees with the formula"
"$scratch/all/hull_and_refusal" || fail "hull_and_refusal: $?"

step "a body of one's own with the engine alone"
quietly "$cmake" --build "$scratch/engine_only" --parallel 2
result="$("$scratch/engine_only/own_body" 1 0.5) $("$scratch/engine_only/own_body" 1 -0.5)"
[ "$result" = "disjoint valid overlap valid" ] || fail "own_body: $result"

step "links of the installed documentation lead somewhere"
[ -f "$prefix/share/doc/vex/docs/derivations.md" ] || fail "the headers refer to docs/derivations.md"
sh "$source_dir/tests/package/check_links.sh" "$prefix/share/doc/vex" "$source_dir" || fail "dead links"

echo "all expectations met"
