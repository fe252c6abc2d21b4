#!/bin/sh
# A project of which vex is a subfolder, as add_subdirectory and FetchContent have it.
#
#   sh tests/package/subdirectory_test.sh SOURCE_DIR CMAKE CACHE GENERATOR
#
# CACHE is an initial cache: compiler, flags and where to look for packages.
set -eu
source_dir=$1
cmake=$2
cache=$3
generator=$4
unset DESTDIR CPPFLAGS
export CXXFLAGS=-O0  # unless the cache has flags

# shellcheck source=tests/package/steps.sh
. "$(dirname -- "$0")/steps.sh"

mkdir "$scratch/project"
cp "$source_dir/tests/consumer/superellipsoid.cpp" "$scratch/project/"
cat >"$scratch/project/both_spellings.cpp" <<'SOURCE'
#include <vex/engine/query/overlap.h>
#include "engine/query/overlap.h"
#include "shapes/sphere.h"
#include <vex/shapes/sphere.h>
double both_spellings() { return vex::Sphere{1.0}.circumradius(); }
SOURCE
cat >"$scratch/project/CMakeLists.txt" <<'PROJECT'
cmake_minimum_required(VERSION 3.25)
project(super LANGUAGES CXX)
add_subdirectory(${VEX_SOURCE_DIR} vex)
add_executable(superellipsoid superellipsoid.cpp)
target_link_libraries(superellipsoid PRIVATE vex::shapes)
add_library(both_spellings OBJECT both_spellings.cpp)
target_link_libraries(both_spellings PRIVATE vex::shapes)
add_library(unrelated OBJECT unrelated.cpp)
file(WRITE ${CMAKE_BINARY_DIR}/build_type "${CMAKE_BUILD_TYPE}")

function(targets_of folder variable)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    targets_of(${below} more)
    list(APPEND targets ${more})
  endforeach()
  set(${variable} ${targets} PARENT_SCOPE)
endfunction()
targets_of(${CMAKE_SOURCE_DIR} targets)
list(JOIN targets "\n" targets)
file(WRITE ${CMAKE_BINARY_DIR}/targets "${targets}\n")
PROJECT
echo 'int unrelated() { return 0; }' >"$scratch/project/unrelated.cpp"

step "configured without what only programs and tests need"
set --
for package in CLI11 nlohmann_json ccd fcl GTest benchmark; do set -- "$@" "-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"; done
quietly "$cmake" -C "$cache" -G "$generator" -S "$scratch/project" -B "$scratch/build" -DVEX_SOURCE_DIR="$source_dir" \
  -DCMAKE_BUILD_TYPE= -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DVEX_WARNINGS_AS_ERRORS=ON "$@"
cd "$scratch/build"

step "kernels of every instruction set would be built"
n_kernels=$(sed -n 's/^vex_packet_kernel_//p' targets | wc -l)
case $(uname -m) in x86_64) [ "$n_kernels" -eq 3 ] || fail "of $n_kernels" ;; esac
# One is built: they differ in nothing but these options, and take longer than all the rest. The libraries are compiled a
# dozen sources at a time, as in a build of vex itself; one by one they take five times as long.
quietly "$cmake" -DVEX_KERNEL_SETS=sse2 -DVEX_UNITY_BUILD=ON .

step "no tests, programs, packages or build type arrive"
grep -qx vex_engine targets || fail "no vex_engine"
if grep -E 'test|bench|program|vex_mesh$|man_pages|app_common|peers' targets; then fail "these targets do"; fi
[ ! -s build_type ] || fail "a build type does: $(cat build_type)"
[ ! -e CPackConfig.cmake ] || fail "CPack does"
quietly "$cmake" --install . --prefix "$scratch/installed"
[ ! -e "$scratch/installed" ] || fail "install rules do"

step "no option but that for rounding arrives, and vex has its own"
# command_of FILE: how it is compiled (a path with a blank stands between \" and \")
command_of() { grep -F -e '"command"' compile_commands.json | grep -e "$1\\\\*\"" || fail "$1 is not compiled"; }
for file in superellipsoid both_spellings; do
  command_of "project/$file.cpp" >"$scratch/command"
  if grep -E -e ' -W(all|extra|error|conversion|shadow)|-fsanitize|-ffile-prefix-map' "$scratch/command"; then fail "$file"; fi
  grep -q -e '-ffp-contract=off' "$scratch/command" || fail "$file would not round as vex does"
done
if command_of project/unrelated.cpp | grep -e '-ffp-contract' -e ' -Werror' -e 'vex/include'; then fail "unrelated.cpp"; fi
command_of 'vex_engine.dir/Unity/unity_0_cxx.cxx' | grep -e '-Wall' | grep -qe '-Werror' || fail "vex is compiled without its warnings"

step "it builds; <vex/engine/...> and \"engine/...\" are the same headers"
quietly "$cmake" --build . --parallel 2 --target superellipsoid both_spellings
[ -x superellipsoid ] || fail "the program is not where the project has its programs"
result=$(./superellipsoid 1 1 1 4 1) || fail "superellipsoid"
printf '  %s, true 55.4100439343\n' "$result"
printf '%s\n' "$result" |
  awk '{ z = ($1 - 55.4100439343) / $2; exit !($2 > 0 && $2 < 0.2 && z < 4 && z > -4 && $3 == 0) }' || fail "another body's"

echo "all expectations met"
