#!/bin/sh
# Hits of the kernels on a device beside the library's own, of the same trials, and the rates of both.
#   tests/opencl/beside_library.sh FOLDER_OF_PROGRAMS opencl|cuda|cpp TRIALS THREADS [SEED]
# FOLDER_OF_PROGRAMS has vex_device_hits and vex_library_hits. Fails where hits, or misses, are not the same.
set -eu
programs=${1:?usage: beside_library.sh FOLDER_OF_PROGRAMS opencl|cuda|cpp TRIALS THREADS [SEED]}
device=$2 trials=$3 threads=$4 seed=${5:-1}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
status=0
of() { sed -n "s/.*$2 \([0-9.]*\).*/\1/p" "$work/$1"; }
echo "| A | B | hits of $trials | left open | the same | kernels, trials/s | library, $threads threads | ratio |"
echo "|---|---|---:|---:|---|---:|---:|---:|"
while read -r a b; do
  "$programs/vex_library_hits" store "$a" "$b" "$work/pair"
  "$programs/vex_device_hits" "$device" "$work/pair" "$seed" "$trials" "$work/list" > "$work/kernels"
  "$programs/vex_library_hits" open "$a" "$b" "$seed" "$work/list" > "$work/rest"
  "$programs/vex_library_hits" hits "$a" "$b" "$seed" "$trials" "$threads" > "$work/library"
  hits=$(($(of kernels hits) + $(of rest hits))) misses=$(($(of kernels misses) + $(of rest misses))) same=yes
  if [ "$hits" != "$(of library hits)" ] || [ "$misses" != "$(of library misses)" ]; then same=NO status=1; fi
  awk -v a="$a" -v b="$b" -v n="$trials" -v hits="$hits" -v open="$(of kernels open)" -v same=$same \
    -v kernels="$(of kernels seconds)" -v rest="$(of rest seconds)" -v library="$(of library seconds)" 'BEGIN {
      kernels += rest
      printf "| %s | %s | %d | %d | %s | %.3g | %.3g | %.3g |\n", a, b, hits, open, same, n / kernels, n / library,
        library / kernels
    }'
done << 'PAIRS'
box:1,1,1 box:1,1,1
ellipsoid:4,1,1 ellipsoid:4,1,1
capsule:1,0.25 capsule:1,0.25
plate:1,1 plate:1,1
box:0.2,1,3 ellipsoid:1,2,3
truncated-icosahedron:0.4 truncated-icosahedron:0.4
PAIRS
sed -n 's/.* on /on: /p' "$work/kernels"
exit $status
