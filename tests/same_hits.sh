#!/bin/sh
# The same hits and verdicts from gcc Debug, gcc Release and clang Release, each with one thread and with two.
#   tests/same_hits.sh FOLDER_TO_BUILD_IN [TRIALS_OF_EACH_PAIR]
# Minutes: three builds of the engine. Also: cmake --build BUILD --target vex_same_hits
set -eu
source_dir=$(cd "$(dirname "$0")/.." && pwd)
work=${1:?usage: tests/same_hits.sh FOLDER_TO_BUILD_IN [TRIALS_OF_EACH_PAIR]}
trials=${2:-200000}
mkdir -p "$work"
first=
for way in "g++ Debug" "g++ Release" "clang++ Release"; do
  compiler=${way% *} type=${way#* }
  if ! command -v "$compiler" > /dev/null; then
    echo "$compiler is not installed (needed for \"$way\") - install it, or compare without it" >&2
    exit 1
  fi
  build="$work/$compiler-$type"
  cmake -S "$source_dir" -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE="$type" > "$work/log"
  cmake --build "$build" --target vex_same_hits_count -j 2 >> "$work/log"
  for threads in 1 2; do
    "$build/bin/vex_same_hits_count" "$trials" "$threads" > "$work/hits"
    if [ -z "$first" ]; then
      first="$work/hits.first"
      cp "$work/hits" "$first"
      cat "$first"
    fi
    if ! diff "$first" "$work/hits"; then
      echo "other hits from $way, $threads threads, than from g++ Debug, 1 thread ($trials trials of each pair)" >&2
      exit 1
    fi
    echo "$way, $threads threads: the same"
  done
done
