#!/bin/sh
# What `sh apps/run` and `sh tests/run` do on machines of every kind, told from the calls they make: copies of the scripts
# run with a PATH that holds nothing but stand-ins for apt-get, sudo, CMake ... and the few tools the scripts may use.
#
#   sh tests/setup/commands_test.sh SOURCE_DIR
set -u
source_dir=$1
unset VEX_PRESET VEX_CMAKE_ARGS CMAKE_BUILD_PARALLEL_LEVEL

all_packages=$(sed -n 's/^\([a-z0-9][^ ]*\).*/\1/p' "$source_dir/cmake/packages.txt" | paste -s -d ' ' -)

scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' HUP INT TERM
tools=$scratch/tools
calls=$scratch/calls
elsewhere=$scratch/elsewhere
mkdir "$tools" "$elsewhere"
export calls

for tool in cat dirname env find flock ln mkdir nproc rm sed sh tail; do
  if path=$(command -v "$tool"); then ln -s "$path" "$tools/$tool"; fi
done

# stand_in NAME: reads its body from standard input.
stand_in() {
  { echo '#!/bin/sh' && cat; } >"$tools/$1"
  chmod +x "$tools/$1"
}

# A Debian machine on which all is installed, an ordinary user with sudo; tests take it from there.
fresh_machine() {
  root=$scratch/"a checkout"
  rm -rf "$root"
  mkdir -p "$root/apps" "$root/tests" "$root/meshes/data"
  cp "$source_dir/apps/run" "$root/apps/"
  cp "$source_dir/tests/run" "$root/tests/"
  cp -R "$source_dir/cmake" "$root/cmake"
  cp "$source_dir/CMakePresets.json" "$root/"
  : >"$calls"
  export user_id=1000 missing='' apt_status=0 configure_status=0 build_status=0 program_status=0

  stand_in id <<'END'
echo "$user_id"
END
  stand_in dpkg-query <<'END'
for name; do
  case "$name" in -*) continue ;; esac
  case " $missing " in
    *" $name "*) echo "no packages found matching $name" >&2 && status=1 ;;
    *) echo "installed $name" ;;
  esac
done
exit "${status:-0}"
END
  stand_in apt-get <<'END'
echo "apt-get $*" >>"$calls"
echo "words of apt-get"
exit "$apt_status"
END
  stand_in sudo <<'END'
echo "sudo" >>"$calls"
exec "$@"
END
  stand_in cmake <<'END'
echo "cmake $*" >>"$calls"
echo "words of cmake"
if [ "$1" = --build ]; then
  [ "$build_status" -eq 0 ] || exit "$build_status"
  mkdir -p "$2/bin"
  ln -sf "$(command -v ctest)" "$2/bin/vex_mesh"
else
  [ "$configure_status" -eq 0 ] || exit "$configure_status"
  while [ "$1" != -S ]; do shift; done
  : >"$2/build/$4/build.ninja"
fi
END
  stand_in ctest <<'END'
echo "in $PWD"
for argument; do echo "argument $argument"; done
exit "$program_status"
END
}

# run COMMAND [ARGUMENTS]: from another folder; leaves $status, $out (standard output) and $err (standard error).
run() {
  command=$1
  shift
  status=0
  (cd "$elsewhere" && PATH=$tools exec sh "$root/$command" "$@") >"$scratch/out" 2>"$scratch/err" || status=$?
  out=$(cat "$scratch/out")
  err=$(cat "$scratch/err")
}

n_failed=0
fail() {
  n_failed=$((n_failed + 1))
  printf 'FAILED: %s: %s\n' "$test_name" "$*"
  printf '  exit code: %s\n' "$status"
  sed 's/^/  stdout: /' "$scratch/out"
  sed 's/^/  stderr: /' "$scratch/err"
  sed 's/^/  call: /' "$calls"
}
expect_status() { [ "$status" -eq "$1" ] || fail "exit code $1 expected"; }
expect_out() { [ "$out" = "$1" ] || fail "standard output expected: $1"; }
expect_said() { case "$err" in *"$1"*) ;; *) fail "message expected: $1" ;; esac }
expect_unsaid() { case "$err" in *"$1"*) fail "message not expected: $1" ;; esac }
expect_called() { grep -q -e "$1" "$calls" || fail "call expected: $1"; }
expect_not_called() { if grep -q -e "$1" "$calls"; then fail "call not expected: $1"; fi; }

it() {
  test_name=$*
  printf '%s\n' "- $test_name"
  fresh_machine
}

it "passes arguments, folder, output and exit code of vex_mesh through"
program_status=4
run apps/run "body with blanks.obj" --json - '*'
expect_status 4
expect_out "in $elsewhere
argument body with blanks.obj
argument --json
argument -
argument *"
expect_called '^cmake --fresh -S .*/a checkout --preset release$'
expect_called '^cmake --build .*/a checkout/build/release --target vex_programs --parallel [1-9]'
expect_unsaid "words of"

it "measures the sample body when it gets no arguments"
run apps/run
expect_status 0
expect_out "in $elsewhere
argument $root/meshes/data/pebble.obj"

it "runs all tests and passes the arguments and the exit code of ctest through"
program_status=8
run tests/run -R "unit test"
expect_status 8
expect_out "in $root
argument --preset
argument release
argument -R
argument unit test"
expect_called '--target all'

it "tests another preset with more arguments for CMake where the environment says so"
VEX_PRESET=asan-ubsan VEX_CMAKE_ARGS='-DA=1 -DB=*' run tests/run
expect_status 0
expect_called '--preset asan-ubsan -DA=1 -DB=\*$'
expect_called '--build .*/build/asan-ubsan'

it "leaves apt-get alone when nothing is missing"
run apps/run
expect_status 0
expect_not_called apt-get

it "configures once and builds every time"
run apps/run
: >"$calls"
run apps/run
run tests/run
expect_status 0
expect_not_called '--preset'
[ "$(grep -c -e --build "$calls")" -eq 2 ] || fail "two builds expected"

it "configures afresh for other arguments, for a moved checkout and for other requirements"
run apps/run
VEX_CMAKE_ARGS=-DA=1 run apps/run
expect_called '-DA=1$'
: >"$calls"
run apps/run
expect_called '--fresh'
: >"$calls"
rm -rf "$scratch/moved" && mv "$root" "$scratch/moved" && root=$scratch/moved
run apps/run
expect_status 0
expect_called '--fresh -S .*/moved '
: >"$calls"
echo "libmore-dev  more" >>"$root/cmake/packages.txt"
missing=libmore-dev
run apps/run
expect_called 'apt-get.* install .* libmore-dev$'
expect_called '--fresh'

it "installs exactly what is missing, with sudo, before it configures"
missing="ninja-build libccd-dev"
run apps/run --version
expect_status 0
expect_out "in $elsewhere
argument --version"
expect_said "installing through apt-get (with sudo): ninja-build libccd-dev"
expect_unsaid "words of"
sed 's/apt-get.* \(update\|install\)/apt-get \1/; s/^\(cmake [^ ]*\).*/\1/' "$calls" >"$scratch/order"
[ "$(cat "$scratch/order")" = "sudo
apt-get update
apt-get install -y --no-install-recommends ninja-build libccd-dev
cmake --fresh
cmake --build" ] || fail "other calls expected"

it "installs as root without sudo"
missing=libqhull-dev
user_id=0
rm "$tools/sudo"
run apps/run
expect_status 0
expect_called 'apt-get.* install .* libqhull-dev$'
expect_said "installing through apt-get: libqhull-dev"

it "installs every package of the list where none is there"
missing=$all_packages
run apps/run
expect_called " --no-install-recommends $missing\$"

it "names what is missing to an ordinary user without sudo"
missing="cmake g++"
rm "$tools/sudo" "$tools/cmake"
run apps/run
expect_status 1
expect_out ""
expect_not_called apt-get
expect_said "apt-get install g++ cmake"
expect_said "please install what is named above"

it "names the packages where there is no apt-get, and builds nevertheless if CMake finds everything"
rm "$tools/apt-get" "$tools/dpkg-query"
run apps/run
expect_status 0
expect_said "apt-get is not here"
for package in $all_packages; do expect_said "$package"; done
run apps/run
expect_status 0
expect_unsaid "apt-get is not here"

it "says so where there is no apt-get and CMake does not find everything"
rm "$tools/apt-get" "$tools/dpkg-query"
configure_status=1
run apps/run
expect_status 1
expect_said "apt-get is not here"
expect_said "words of cmake"
expect_said "please install what is named above"

it "shows apt-get's words when it fails"
missing=libccd-dev
apt_status=100
configure_status=1
run tests/run
expect_status 1
expect_out ""
expect_said "words of apt-get"
expect_said "apt-get install libccd-dev"

it "asks sudo once, and says what root should install where sudo refuses"
missing=libccd-dev
configure_status=1
stand_in sudo <<'END'
echo "sudo refused" >>"$calls"
echo "words of sudo"
exit 1
END
run tests/run
expect_status 1
expect_said "words of sudo"
expect_said "apt-get install libccd-dev"
expect_not_called apt-get
[ "$(grep -c sudo "$calls")" -eq 1 ] || fail "one call of sudo expected"

it "installs from the package lists that are there when apt-get cannot update them"
missing=libccd-dev
stand_in apt-get <<'END'
echo "apt-get $*" >>"$calls"
case "$*" in *update*) exit 100 ;; esac
END
run apps/run
expect_status 0
expect_called 'apt-get.* install .* libccd-dev$'

it "shows the compiler's words when it fails, and then looks again for what may be missing"
build_status=2
run tests/run
expect_status 1
expect_out ""
expect_said "words of cmake"
expect_said "building failed"
build_status=0
missing=libccd-dev
run tests/run
expect_status 0
expect_called 'apt-get.* install .* libccd-dev$'

it "says so where the checkout cannot be written to"
: >"$root/build"
run apps/run
expect_status 1
expect_said "cannot write to $root/build/release"

it "reads as shell throughout"
for script in apps/run tests/run cmake/*.sh tests/setup/*.sh; do
  for path in "$source_dir"/$script; do sh -n "$path" || fail "sh -n $path"; done
done
if has_bash=$(command -v bash); then "$has_bash" -n "$source_dir/.ci/run" || fail "bash -n .ci/run"; fi

if [ "$n_failed" -gt 0 ]; then
  echo "$n_failed expectations failed"
  exit 1
fi
echo "all expectations met"
